// SPDX-License-Identifier: Apache-2.0
// Where baked objects stand in the scene: their vertices there are those of the bake, turned and moved.
#include "environment/bake/caster.h"
#include "environment/bake/placement.h"
#include "scene/corners.h"
#include "scene/scene.h"
#include "tests/environment/bakes.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::placement_test {

/// The largest distance between the caster's vertices in the scene and where the placement has them.
double largest_distance(const preset::Preset& preset)
{
  const environment::Caster caster = environment::make_caster(preset);
  const scene::Scene scene = scene::load_scene(preset);
  const environment::Placement placement = environment::placement(preset, caster, scene);
  EXPECT_NEAR(glm::determinant(placement.turn), 1, 1e-12);
  EXPECT_EQ(caster.objects.size(), caster.scene.objects.size());
  double largest = 0;
  for (std::size_t i = 0; i < caster.objects.size(); ++i) {
    std::vector<glm::dvec3> baked, placed;
    for_each_corner(caster.scene, caster.scene.objects[i], [&](const glm::dvec3& p) { baked.push_back(p); });
    for_each_corner(scene, scene.objects[caster.objects[i]], [&](const glm::dvec3& p) { placed.push_back(p); });
    EXPECT_EQ(baked.size(), placed.size());
    for (std::size_t k = 0; k < std::min(baked.size(), placed.size()); ++k) {
      largest = std::max(largest, glm::distance(placement.turn * baked[k] + placement.middle, placed[k]));
    }
  }
  return largest;
}

// A mesh without symmetry, whose box's middle is not its own origin, among other things, so that the scene's origin is elsewhere.
TEST(Placement, TakesTheBakesVerticesToTheScenes)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("stone.obj", "v 3 0.2 -0.3\nv 1.5 0.9 0.1\nv 1.6 -0.8 0.2\nv 2.1 0.1 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
                                                     "f 3 1 4\n");
  const std::string wall = R"({"name": "wall", "shape": {"type": "quad", "size": [9, 1, 9]}, "material": "wall"})",
                    mirror =
                        R"({"name": "mirror", "shape": {"type": "quad"}, "material": "mirror", "transform": {"translate": [8, 1, 2]}})";
  for (const char* transform : {"{}", R"({"translate": [4, -5, 6]})", R"({"rotate_deg": [10, 20, 30]})",
                                R"({"scale": [1, 2, 0.5], "rotate_deg": [170, -85, 95], "translate": [1, 2, 3]})",
                                R"({"scale": [-1, 1, 1], "rotate_deg": [0, 90, 0], "translate": [100, 0, 0]})"}) {
    const std::string stone = R"({"name": "stone", "mesh": ")" + file + R"(", "material": "glass", "transform": )" + transform + "}";
    EXPECT_LT(largest_distance(bake_preset(wall + ", " + stone + ", " + mirror, {"environment.objects=[\"stone\"]"})), 1e-5) << transform;
  }
}

} // namespace nephroid::placement_test
