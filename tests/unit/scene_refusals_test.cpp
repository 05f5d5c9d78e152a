// SPDX-License-Identifier: Apache-2.0
// What a scene refuses, and that it points at the right place: contradictions between fields; ranges are for the reader of presets.
#include "tests/support/loaded_scenes.h"

namespace nephroid::scene::scene_refusals_test {

struct Wrong {
  const char* says;
  std::function<void(preset::Scene&)> change;
};

TEST(SceneRefusals, PointAtTheRightPlace)
{
  using S = preset::Scene;
  const Wrong wrongs[] = {
      {"p.json#/scene/objects/1/name: 'ball' is also object 0", [](S& s) { s.objects[1].name = "ball"; }},
      {"p.json#/scene/objects/0/mesh: 'no.obj' not found",
       [](S& s) {
         s.objects[0].shape.reset();
         s.objects[0].mesh = "no.obj";
       }},
      {"p.json#/scene/objects/0: is 1e-09 units across",
       [](S& s) {
         s.objects[0].transform.scale = {1e-9, 1e-9, 1e-9};
       }},
      {"p.json#/scene/objects/1: reaches 5e+10 units away",
       [](S& s) {
         s.objects[1].transform.scale = {1e11, 1, 1};
       }},
      {"p.json#/scene/objects/0: has a vertex at",
       [](S& s) {
         s.objects[0].transform.scale = {1e300, 1, 1};
       }},
      {"p.json#/scene/lights/0/position: (0, 1e+12, 0) is too far away", [](S& s) { s.lights[0].position[1] = 1e12; }},
      {"p.json#/scene/lights/0/spectrum: ", [](S& s) { s.lights[0].spectrum.illuminant = "D66"; }},
      {"p.json#/scene/lights/0/direction: (0, 0, 0) has no direction",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::directional;
         s.lights[0].direction = {0, 0, 0};
       }},
      {"p.json#/scene/lights/0/up: (0, 1, 0) is parallel",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::area;
         s.lights[0].up = {0, 1, 0};
       }},
      {"p.json#/scene/materials/a~1b~0c/dispersion: ",
       [](S& s) {
         s.materials["a/b~c"].type = preset::Material::Type::dielectric;
         s.materials["a/b~c"].dispersion.n = -1;
       }},
      {"p.json#/scene/camera/target: (0, 0, 0) has no direction", [](S& s) { s.camera.target = s.camera.position; }},
  };
  for (const Wrong& wrong : wrongs) {
    preset::Preset preset = ball_over_floor();
    wrong.change(preset.scene);
    EXPECT_THAT(refusal(preset), testing::StartsWith(wrong.says));
  }
}

} // namespace nephroid::scene::scene_refusals_test
