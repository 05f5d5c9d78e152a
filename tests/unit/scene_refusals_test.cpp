// SPDX-License-Identifier: Apache-2.0
// What a scene refuses, and that it points at the right place: contradictions that a preset made by a program may hold, too.
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
      {"p.json#/scene/objects/0/material: there is no material 'glas'; one of glass, mirror, wall; did you mean 'glass'?",
       [](S& s) { s.objects[0].material = "glas"; }},
      {"p.json#/scene/objects/0/material: there is no material 'glass'; scene.materials is empty", [](S& s) { s.materials.clear(); }},
      {"p.json#/scene/objects/1/name: 'ball' is also object 0", [](S& s) { s.objects[1].name = "ball"; }},
      {"p.json#/scene/objects/0: has neither 'mesh' nor 'shape'", [](S& s) { s.objects[0].shape.reset(); }},
      {"p.json#/scene/objects/0: has both 'mesh' and 'shape'", [](S& s) { s.objects[0].mesh = "a.obj"; }},
      {"p.json#/scene/objects/0/mesh: 'no.obj' not found",
       [](S& s) {
         s.objects[0].shape.reset();
         s.objects[0].mesh = "no.obj";
       }},
      {"p.json#/scene/objects/0/shape/radius: 0 is out of range", [](S& s) { s.objects[0].shape->radius = 0; }},
      {"p.json#/scene/objects/0/transform/scale/1: the factor is 0", [](S& s) { s.objects[0].transform.scale[1] = 0; }},
      {"p.json#/scene/objects/0/transform/rotate_deg/2: is not", [](S& s) { s.objects[0].transform.rotate_deg[2] = std::nan(""); }},
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
      {"p.json#/scene/lights/0/power_w: the power is -1", [](S& s) { s.lights[0].power_w = -1; }},
      {"p.json#/scene/lights/0/spectrum: ", [](S& s) { s.lights[0].spectrum.illuminant = "D66"; }},
      {"p.json#/scene/lights/0/direction: (0, 0, 0) has no direction",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::directional;
         s.lights[0].direction = {0, 0, 0};
       }},
      {"p.json#/scene/lights/0/half_angle_deg: the half angle is 0",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::spot;
         s.lights[0].half_angle_deg = 0;
       }},
      {"p.json#/scene/lights/0/size/1: the edge length is 0",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::area;
         s.lights[0].size[1] = 0;
       }},
      {"p.json#/scene/lights/0/up: (0, 1, 0) is parallel",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::area;
         s.lights[0].up = {0, 1, 0};
       }},
      {"p.json#/scene/materials/wall/reflectance: the reflectance is 1.5", [](S& s) { s.materials["wall"].reflectance.value = 1.5; }},
      {"p.json#/scene/materials/a~1b~0c/dispersion: ",
       [](S& s) {
         s.materials["a/b~c"].type = preset::Material::Type::dielectric;
         s.materials["a/b~c"].dispersion.n = -1;
       }},
      {"p.json#/scene/camera/target: is where the camera stands", [](S& s) { s.camera.target = s.camera.position; }},
  };
  for (const Wrong& wrong : wrongs) {
    preset::Preset preset = ball_over_floor();
    wrong.change(preset.scene);
    EXPECT_THAT(refusal(preset), testing::StartsWith(wrong.says));
  }
}

} // namespace nephroid::scene::scene_refusals_test
