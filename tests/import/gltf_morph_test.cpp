// SPDX-License-Identifier: Apache-2.0
// Morph targets of glTF and the animation of their weights: what becomes of them, and how damage is refused.
#include "scene/scene.h"
#include "tests/support/gltf.h"

namespace nephroid::gltf_morph_test {

using Json = nlohmann::json;
using test::GltfImport;
using test::triangle;
using test::triangle_bytes;

class GltfMorph : public GltfImport {};

/// A triangle with a morph target that lifts it by 2, at half its weight in the file's rest, and a channel of weights.
Json morphing_triangle() {
  Json json = triangle();
  const float numbers[] = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0.5, 1, 0, 1, 0.25};
  std::string bytes = triangle_bytes();
  bytes.resize(44);
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof numbers);
  std::memcpy(bytes.data() + begin, numbers, sizeof numbers);
  json["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
  for (const auto& [offset, length] : {std::pair{44, 36}, {80, 12}, {92, 12}})
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
  for (const auto& [view, type] : {std::pair{2, "VEC3"}, {3, "SCALAR"}, {4, "SCALAR"}})
    json["accessors"].push_back({{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", type}});
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 2}}};
  json["meshes"][0]["weights"] = {0.5};
  json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
                         {"samplers", {{{"input", 3}, {"output", 4}}}}}};
  return json;
}

TEST_F(GltfMorph, MorphTargetsBecomeStatesAndTheirWeightsTracks) {
  Json still = morphing_triangle();
  still.erase("animations");
  const preset::Preset rest = imported(still);
  EXPECT_FALSE(rest.animation);
  ASSERT_EQ(rest.scene.objects[0].states.size(), 1u);
  EXPECT_EQ(rest.scene.objects[0].states[0].weight, 0.5);
  const scene::Scene scene = scene::load_scene(rest);
  EXPECT_EQ(scene.origin.z + scene.geometry.positions[0].z, 1);

  const preset::Preset moving = imported(morphing_triangle());
  ASSERT_TRUE(moving.animation);
  EXPECT_EQ(moving.animation->frames, 25); // a second at 24 a second
  ASSERT_EQ(moving.animation->tracks.size(), 1u);
  EXPECT_EQ(moving.animation->tracks[0].path, "scene.objects.0.states.0.weight");
  const std::vector<preset::Key> keys{{0, {0}}, {12, {1}}, {24, {0.25}}};
  EXPECT_EQ(moving.animation->tracks[0].keys, keys);
  EXPECT_EQ(moving.scene.objects[0].states[0].weight, 0);
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("morph"))));
}

TEST_F(GltfMorph, DamagedMorphTargetsAreRefusedAtTheirPlace) {
  Json few = morphing_triangle(), short_of_times = few, turning_back = few, nowhere = few;
  few["accessors"][2]["count"] = 2;
  EXPECT_THAT(refusal(few), HasSubstr("#/meshes/0/primitives/0/targets: has 2 POSITIONS of 3 vertices"));
  short_of_times["accessors"][4]["count"] = 2;
  EXPECT_THAT(refusal(short_of_times), HasSubstr("#/animations/0/samplers/0: has 2 numbers at 3 times"));
  turning_back["bufferViews"][3]["byteOffset"] = 92;
  EXPECT_THAT(refusal(turning_back), HasSubstr("its times do not rise"));
  nowhere["animations"][0]["channels"][0]["sampler"] = 1;
  EXPECT_THAT(refusal(nowhere), HasSubstr("#/animations/0/channels/0/sampler"));
}

} // namespace nephroid::gltf_morph_test
