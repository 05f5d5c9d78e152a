// SPDX-License-Identifier: Apache-2.0
// What other programs write into glTF files: instances, hidden nodes, numbers of every type, strips, buffers of any
// kind, extensions that change no triangle; and files that say more than they hold.
#include "formats/import/import.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "scene/mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace nephroid::gltf_accessors_test {

using Json = nlohmann::json;

constexpr int type_int8 = 5120, type_uint8 = 5121, type_int16 = 5122, type_uint16 = 5123, type_float = 5126;

/// A file with one buffer, to which accessors are added.
struct File {
  Json json = Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"name":"tri"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[],"bufferViews":[]})");
  std::string bytes;

  template <class T>
  int view(const std::vector<T>& values) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}});
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }
  template <class T>
  int accessor(const std::vector<T>& values, int component, const char* type, std::size_t count) {
    const int index = view(values);
    json["accessors"].push_back(
        {{"bufferView", index}, {"componentType", component}, {"count", count}, {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  std::string text(const std::string& head = "data:application/octet-stream;base64,") const {
    Json whole = json;
    whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", head + base64(bytes)}}};
    return whole.dump();
  }
};

/// Corners (0, 0, 0), (1, 0, 0), (0, 1, 0).
File triangle() {
  File file;
  file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, type_float, "VEC3", 3);
  return file;
}

class GltfAccessors : public testing::Test {
protected:
  preset::Preset imported(const std::string& text) {
    made = formats::import_scene(folder.write("in.gltf", text), folder.path() / "out.json");
    return preset::read_preset(made.preset.string());
  }
  std::vector<glm::vec3> positions(const std::string& text) {
    return scene::load_mesh(folder.path() / *imported(text).scene.objects.at(0).mesh).positions;
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { imported(text); });
  }
  test::TemporaryFolder folder;
  formats::Imported made;
};

TEST_F(GltfAccessors, EveryInstanceIsAnObject) {
  File file = triangle();
  file.json["nodes"][0]["translation"] = {0, 0, 5};
  // The second one is turned by 90 degrees about z: (0, 0, sin 45, cos 45) of 127 is 90 after rounding, twice.
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.accessor<float>({0, 0, 0, 2, 0, 0, 4, 0, 0}, type_float, "VEC3", 3)},
      {"ROTATION", file.accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 90, 90, 0, 0, 0, 127}, type_int8, "VEC4", 3)},
      {"SCALE", file.accessor<float>({1, 1, 1, 1, 1, 1, 3, 3, 3}, type_float, "VEC3", 3)}};
  file.json["accessors"][2]["normalized"] = true;
  const preset::Preset p = imported(file.text());
  ASSERT_EQ(p.scene.objects.size(), 3u);
  EXPECT_EQ(made.meshes, 1u);
  EXPECT_EQ(p.scene.objects[2].name, "tri 3");
  const auto transform = [&](int i) { return p.scene.objects[static_cast<std::size_t>(i)].transform; };
  EXPECT_EQ(transform(1).translate, (preset::Vec3{2, 0, 5}));
  EXPECT_THAT(transform(1).rotate_deg, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(0, 1e-9), DoubleNear(90, 1e-9)));
  EXPECT_EQ(transform(2).scale, (preset::Vec3{3, 3, 3}));

  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 0;
  file.json["accessors"][0]["count"] = 2;
  EXPECT_THAT(refusal(file.text()), HasSubstr("/SCALE: has 2 items where others have 3"));
}

TEST_F(GltfAccessors, ManyObjectsOfOneName) {
  File file = triangle();
  const std::vector<float> places(30003, 0);
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.accessor(places, type_float, "VEC3", 10001)}};
  EXPECT_THAT(refusal(file.text()), HasSubstr("in.gltf: has 10001 objects; expected at most 10000; join"));
  file.json["accessors"][1]["count"] = 10000;
  EXPECT_EQ(imported(file.text()).scene.objects.back().name, "tri 10000");
}

TEST_F(GltfAccessors, WhatIsHiddenIsLeftOutAndSaid) {
  File file = triangle();
  file.json["nodes"] = Json::parse(R"([{"mesh":0,"name":"seen"},{"name":"hidden","children":[2],
    "extensions":{"KHR_node_visibility":{"visible":false}}},
    {"mesh":0,"name":"below","extensions":{"KHR_node_visibility":{"visible":true}}}])");
  file.json["scenes"][0]["nodes"] = {0, 1};
  const preset::Preset p = imported(file.text());
  ASSERT_EQ(p.scene.objects.size(), 1u);
  EXPECT_EQ(p.scene.objects[0].name, "seen");
  EXPECT_THAT(made.notes, Contains(HasSubstr("hides (KHR_node_visibility)")));
}

TEST_F(GltfAccessors, ExtensionsAreDoneOrNamed) {
  File file = triangle();
  file.json["extensionsRequired"] = {"KHR_texture_basisu", "KHR_mesh_quantization", "KHR_materials_variants"};
  file.json["extensionsUsed"] = {"KHR_texture_basisu", "KHR_xmp_json_ld", "ACME_odd"};
  imported(file.text());
  EXPECT_THAT(made.notes, Contains("extensions that are left out: ACME_odd, KHR_texture_basisu, KHR_xmp_json_ld"));
  EXPECT_THAT(made.notes, Contains(HasSubstr("variants (KHR_materials_variants)")));
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("quantization"))));
  file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/extensionsRequired: the file's triangles are compressed by "
                                              "EXT_meshopt_compression; expected triangles that are not; export it"));
  file.json["extensionsRequired"] = {7};
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/extensionsRequired/0: is of a wrong kind"));
  // A file that uses Draco and does not require it may have no other data all the same.
  file.json.erase("extensionsRequired");
  file.json["accessors"][0].erase("bufferView");
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/accessors/0: has no data that is read here"));
}

TEST_F(GltfAccessors, NumbersOfEveryTypeAndStride) {
  // KHR_mesh_quantization: 16 bits, normalized, of which every fourth number is padding; 8 bits for the corners.
  File file;
  file.accessor<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 0, -32767, 0, 9}, type_int16, "VEC3", 3);
  file.json["accessors"][0]["normalized"] = true;
  file.json["bufferViews"][0]["byteStride"] = 8;
  file.json["meshes"][0]["primitives"][0]["indices"] = file.accessor<std::uint8_t>({0, 2, 1}, type_uint8, "SCALAR", 3);
  EXPECT_THAT(positions(file.text()),
              UnorderedElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0)));
  file.json["accessors"][0].erase("normalized");
  file.json["nodes"][0]["scale"] = {1.0 / 32767, 1.0 / 32767, 1.0 / 32767};
  EXPECT_THAT(positions(file.text()), Contains(glm::vec3(32767, 0, 0)));
  file.json["accessors"][1]["componentType"] = 5124;
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/accessors/1/componentType: is no type of glTF"));
}

TEST_F(GltfAccessors, SparseItemsTakeTheOthersPlace) {
  File file = triangle();
  const int places = file.view<std::uint16_t>({1}), values = file.view<float>({3, 0, 0});
  Json& sparse = file.json["accessors"][0]["sparse"];
  sparse = {{"count", 1},
            {"indices", {{"bufferView", places}, {"componentType", type_uint16}}},
            {"values", {{"bufferView", values}}}};
  EXPECT_THAT(positions(file.text()), UnorderedElementsAre(glm::vec3(0, 0, 0), glm::vec3(3, 0, 0), glm::vec3(0, 1, 0)));
  sparse["count"] = 4;
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/accessors/0/sparse/count: is 4 of 3 items"));
  sparse["count"] = 2;
  EXPECT_THAT(refusal(file.text()), HasSubstr("its 2 items end at byte 4 of a buffer view of 2"));
  file.json["accessors"][0].erase("bufferView");
  file.json["accessors"][0]["count"] = 4000000000u;
  EXPECT_THAT(refusal(file.text()), HasSubstr("#/accessors/0/sparse"));
}

TEST_F(GltfAccessors, StripsAndFans) {
  File file;
  file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, type_float, "VEC3", 4);
  file.json["meshes"][0]["primitives"][0]["mode"] = 5; // both triangles of the square face +z
  EXPECT_EQ(positions(file.text()).size(), 4u);
  const auto volume_below = [&] { // over the plane z = -1, by what faces up
    const scene::Mesh mesh = scene::load_mesh(folder.path() / "out-meshes/tri.ply");
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles)
      area += 0.5 * glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z;
    return area;
  };
  EXPECT_DOUBLE_EQ(volume_below(), 1);
  file.json["meshes"][0]["primitives"][0]["mode"] = 6; // (0, 1, 2) and, turned away, (0, 2, 3)
  EXPECT_EQ(positions(file.text()).size(), 4u);
  EXPECT_DOUBLE_EQ(volume_below(), 0);
}

TEST_F(GltfAccessors, BuffersOfAnyKindAndLength) {
  EXPECT_EQ(positions(triangle().text("data:application/gltf-buffer;base64,")).size(), 3u);
  EXPECT_EQ(positions(triangle().text("data:;base64,")).size(), 3u);
  File longer = triangle();
  longer.bytes += "more than is used";
  EXPECT_EQ(positions(longer.text()).size(), 3u);
  Json shorter = Json::parse(triangle().text());
  shorter["buffers"][0]["byteLength"] = 40;
  EXPECT_THAT(refusal(shorter.dump()), HasSubstr("#/buffers/0/byteLength: is 40, and there are 36 bytes; copy"));
  EXPECT_THAT(refusal(triangle().text("data:;base64,!")), HasSubstr("#/buffers/0/uri: is no base64"));
  // Another buffer that no triangle uses may be missing.
  Json pictures = Json::parse(triangle().text());
  pictures["buffers"].push_back({{"byteLength", 5}, {"uri", "gone.png"}});
  EXPECT_EQ(positions(pictures.dump()).size(), 3u);
}

TEST_F(GltfAccessors, WhatCannotBeSeenIsLeftOutAndSaid) {
  File file = triangle();
  file.json["meshes"].push_back(
      {{"name", "line"},
       {"primitives",
        {{{"attributes", {{"POSITION", file.accessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0}, type_float, "VEC3", 3)}}}},
         {{"attributes", Json::object()}}}}});
  file.json["nodes"].push_back({{"mesh", 1}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(imported(file.text()).scene.objects.size(), 1u);
  EXPECT_THAT(made.notes, Contains("a part of 'line' has no triangle with an area and is left out"));
  EXPECT_THAT(made.notes, Contains("a part of 'line' has no positions and is left out"));
}

TEST_F(GltfAccessors, AColourOfGlassIsItsTint) {
  File file = triangle();
  file.json["materials"] = Json::parse(R"([{"name":"pane","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.8,0.1,1],
    "roughnessFactor":0,"metallicFactor":0},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},
    "KHR_materials_volume":{"thicknessFactor":1}}}])");
  file.json["meshes"][0]["primitives"][0]["material"] = 0;
  const preset::Material tinted = imported(file.text()).scene.materials.at("pane");
  const auto at_nm = [&](double nm) {
    return scatter::make_reflectance(tinted.tint, "tint")[static_cast<std::size_t>(nm - 380)];
  };
  EXPECT_GT(at_nm(540), 4 * at_nm(640));
  EXPECT_FALSE(tinted.thin);
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
  imported(file.text());
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("tints"))));
}

} // namespace nephroid::gltf_accessors_test
