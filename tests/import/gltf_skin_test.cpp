// SPDX-License-Identifier: Apache-2.0
// Skins of glTF: meshes stand where their joints have them, as these rest.
#include "scene/scene.h"
#include "tests/support/gltf.h"

namespace nephroid::gltf_skin_test {

using Json = nlohmann::json;

/// Adds numbers to the file and returns their accessor.
template <class Number>
std::size_t add(Json& json, const std::vector<Number>& numbers, int component, std::size_t count, const char* type) {
  const std::size_t bytes = numbers.size() * sizeof(Number);
  json["bufferViews"].push_back({{"buffer", json["buffers"].size()}, {"byteLength", bytes}});
  json["buffers"].push_back({{"byteLength", bytes},
                             {"uri", "data:application/octet-stream;base64," +
                                         base64(std::string(reinterpret_cast<const char*>(numbers.data()), bytes))}});
  json["accessors"].push_back(
      {{"bufferView", json["bufferViews"].size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
  return json["accessors"].size() - 1;
}

/// A triangle of two joints: the first, which is in place, has the first corner; the second, a quarter turn about z at
/// x = 1 in the world, has the second; the third has half of each. Its own node would put it elsewhere.
Json skinned() {
  Json json = test::triangle();
  json["nodes"][0].update({{"skin", 0}, {"scale", {100, 100, 100}}, {"translation", {5, 0, 0}}});
  json["nodes"].push_back({{"name", "bone"}, {"children", {2}}, {"translation", {0, 0, 2}}});
  json["nodes"].push_back({{"translation", {1, 0, 0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
  json["scenes"][0]["nodes"] = {0, 1};
  std::vector<float> inverse(32);
  for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) inverse[i] = 1;
  inverse[14] = -2; // at rest the first joint moves nothing
  inverse[30] = -2;
  auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  const std::size_t joints = add<std::uint8_t>(json, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, 3, "VEC4"),
                    weights = add<float>(json, {1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0}, 5126, 3, "VEC4");
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  attributes["NORMAL"] = add<float>(json, {0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 1}, 5126, 3, "VEC3");
  json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", add(json, inverse, 5126, 2, "MAT4")}}};
  return json;
}

class GltfSkin : public test::GltfImport {
protected:
  /// Corner i of the first object, in the world.
  glm::dvec3 corner(const scene::Scene& scene, std::size_t i) {
    return scene.origin + glm::dvec3(scene.geometry.positions[i]);
  }
  void expect_near(const glm::dvec3& is, const glm::dvec3& expected) {
    EXPECT_LT(glm::length(is - expected), 1e-6) << is.x << " " << is.y << " " << is.z;
  }
};

TEST_F(GltfSkin, VerticesStandWhereTheirJointsHaveThem) {
  const preset::Preset p = imported(skinned());
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("skin"))));
  const scene::Scene scene = scene::load_scene(p);
  expect_near(corner(scene, 0), {0, 0, 0});
  expect_near(corner(scene, 1), {1, 1, 0});   // (1, 0, 0) is turned to (0, 1, 0), and moved by 1
  expect_near(corner(scene, 2), {0, 0.5, 0}); // between (0, 1, 0) and (0, 0, 0)
  const scene::Mesh mesh = scene::load_mesh(folder.path() / *p.scene.objects[0].mesh);
  expect_near(glm::dvec3(mesh.normals[1]), {-0.6, 0, 0.8});
}

TEST_F(GltfSkin, WithoutInverseMatricesTheyAreTheIdentity) {
  Json json = skinned();
  json["skins"][0].erase("inverseBindMatrices");
  expect_near(corner(scene::load_scene(imported(json)), 0), {0, 0, 2});
}

TEST_F(GltfSkin, MorphTargetsAreMovedAsWell) {
  Json json = skinned();
  json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", add<float>(json, {0, 0, 0, 1, 0, 0, 0, 0, 0}, 5126, 3, "VEC3")}}};
  json["meshes"][0]["weights"] = {0.5};
  expect_near(corner(scene::load_scene(imported(json)), 1), {1, 1.5, 0});
}

TEST_F(GltfSkin, AMeshWithoutJointsStandsWhereItsNodeDoes) {
  Json json = skinned();
  json["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
  expect_near(corner(scene::load_scene(imported(json)), 1), {105, 0, 0});
  EXPECT_THAT(made.notes, Contains(HasSubstr("has no joints: its skin does not move it")));
}

TEST_F(GltfSkin, WhatDoesNotFitIsRefused) {
  Json few = skinned(), far = few, nowhere = few, light = few;
  few["skins"][0]["joints"] = {1};
  EXPECT_THAT(refusal(few), HasSubstr("#/meshes/0/primitives/0: has joint 1 of 1"));
  far["skins"][0]["joints"] = {1, 2, 1};
  EXPECT_THAT(refusal(far), HasSubstr("#/skins/0: has 2 matrices of 3 joints"));
  nowhere["scenes"][0]["nodes"] = {0};
  EXPECT_THAT(refusal(nowhere), HasSubstr("#/skins/0/joints/0: node 1 is not in the scene"));
  auto& attributes = light["meshes"][0]["primitives"][0]["attributes"];
  attributes["WEIGHTS_0"] = add<float>(light, std::vector<float>(12), 5126, 3, "VEC4");
  imported(light);
  EXPECT_THAT(made.notes, Contains(HasSubstr("have no weights: the first joint of its skin moves them")));
}

} // namespace nephroid::gltf_skin_test
