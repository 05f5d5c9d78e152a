// SPDX-License-Identifier: Apache-2.0
// Surfaces that a glTF file leaves out by their alpha: of a factor, of a picture, of colours of corners.
#include "image/image.h"
#include "tests/support/gltf.h"

namespace nephroid::gltf_alpha_test {

using Json = nlohmann::json;

class GltfAlpha : public test::GltfImport {
protected:
  /// The triangle, and before it another one with this material.
  static Json two(const Json& material) {
    Json json = test::triangle();
    json["materials"].push_back(material);
    json["meshes"].push_back(json["meshes"][0]);
    json["meshes"][1]["primitives"][0]["material"] = 1;
    json["nodes"].push_back({{"mesh", 1}, {"name", "veil"}});
    json["scenes"][0]["nodes"] = {1, 0};
    return json;
  }
  static Json faint(const char* mode, double alpha) {
    return {{"name", "veil"},
            {"alphaMode", mode},
            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}, {"metallicFactor", 0}}}};
  }
  /// A material whose picture has two texels with these alphas, and its mesh u, v.
  Json pictured(const char* mode, int first, int second, bool is_own) {
    const auto at = [](int alpha) { return static_cast<unsigned char>(alpha); };
    image::write_png_bytes(folder.path() / "veil.png", 2, 1, {9, 9, 9, at(first), 9, 9, 9, at(second)});
    Json json = two(faint(mode, 1));
    json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    json["textures"] = {{{"source", 0}}};
    json["images"] = {{{"uri", is_own ? "data:image/png;base64," + base64(read_file(folder.path() / "veil.png"))
                                      : std::string("veil.png")}}};
    return json;
  }
  /// Of the file, whether the veil is there.
  bool has_veil(const Json& json) {
    const preset::Preset made_of_it = imported(json);
    EXPECT_EQ(made_of_it.scene.objects.back().name, "tri");
    return made_of_it.scene.objects.size() == 2;
  }
  auto says(const char* what) const { return testing::Contains(HasSubstr(what)); }
};

TEST_F(GltfAlpha, AFactorBelowTheCutoffLeavesASurfaceOut) {
  EXPECT_FALSE(has_veil(two(faint("MASK", 0.3))));
  EXPECT_THAT(made.notes, Not(says("'veil'")));
  EXPECT_TRUE(has_veil(two(faint("MASK", 0.5)))); // at the cutoff it is there
  EXPECT_THAT(made.notes, Not(says("'veil'")));
  Json low = faint("MASK", 0.3), high = faint("MASK", 0.9);
  low["alphaCutoff"] = 0.2;
  high["alphaCutoff"] = 1.5; // above 1 nothing is there
  EXPECT_TRUE(has_veil(two(low)));
  EXPECT_FALSE(has_veil(two(high)));
  EXPECT_TRUE(has_veil(two(faint("OPAQUE", 0))));
  EXPECT_FALSE(has_veil(two(faint("BLEND", 0))));
  EXPECT_TRUE(has_veil(two(faint("BLEND", 0.7))));
  EXPECT_THAT(made.notes, says("'veil' is opaque here"));
  EXPECT_TRUE(has_veil(two(faint("BLEND", 1))));
  EXPECT_THAT(made.notes, Not(says("'veil'")));
}

TEST_F(GltfAlpha, WhatHasNoAlphaDoesNotShine) {
  Json lamp = faint("MASK", 0.1);
  lamp["emissiveFactor"] = {1, 1, 1};
  EXPECT_FALSE(has_veil(two(lamp)));
  EXPECT_THAT(made.notes, says("no lights that can be taken over"));
}

TEST_F(GltfAlpha, APicturesAlphaCountsToo) {
  for (const bool is_own : {false, true}) {
    EXPECT_FALSE(has_veil(pictured("MASK", 0, 100, is_own)));
    EXPECT_TRUE(has_veil(pictured("MASK", 200, 255, is_own)));
    EXPECT_THAT(made.notes, Not(says("by its alpha")));
    EXPECT_TRUE(has_veil(pictured("MASK", 100, 255, is_own)));
    EXPECT_THAT(made.notes, says("'veil' has holes by its alpha in the file and is whole here"));
    EXPECT_FALSE(has_veil(pictured("BLEND", 0, 0, is_own)));
    EXPECT_TRUE(has_veil(pictured("BLEND", 0, 255, is_own)));
    EXPECT_THAT(made.notes, says("'veil' is opaque here"));
  }
  Json weak = pictured("MASK", 200, 200, false);
  weak["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.6}; // .47 with the picture's
  EXPECT_FALSE(has_veil(weak));
}

TEST_F(GltfAlpha, CornersAlphaCountsToo) {
  Json json = two(faint("MASK", 1));
  json["accessors"].push_back({{"count", 3}, {"componentType", 5126}, {"type", "VEC4"}});
  json["accessors"][2]["sparse"] = {
      {"count", 3}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}};
  const float colours[] = {1, 1, 1, 0.1F, 1, 1, 1, 0.2F, 1, 1, 1, 0.4F};
  json["buffers"].push_back({{"byteLength", sizeof colours},
                             {"uri", "data:application/octet-stream;base64," +
                                         base64(std::string(reinterpret_cast<const char*>(colours), sizeof colours))}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", sizeof colours}});
  json["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  EXPECT_FALSE(has_veil(json));
  json["materials"][1]["alphaCutoff"] = 0.3;
  EXPECT_TRUE(has_veil(json));
  EXPECT_THAT(made.notes, says("'veil' has holes by its alpha"));
}

} // namespace nephroid::gltf_alpha_test
