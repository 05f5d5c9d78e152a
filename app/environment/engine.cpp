// SPDX-License-Identifier: Apache-2.0
#include "environment/engine.h"

#include "environment/checks.h"
#include "environment/job.h"
#include "environment/settings.h"
#include "environment/view/scene_view.h"

#include <algorithm>

namespace nephroid::environment {
namespace {

// Cauchy's formula with the two terms that fit N-BK7.
constexpr const char* new_scene = R"({
  "name": "untitled", "description": "A glass sphere on a floor under an evening sky", "engine": "environment",
  "unit": "cm", "white": 4,
  "scene": {
    "camera": {"position": [0.5, 5, 7], "target": [0.9, 0.3, -0.2], "fov_deg": 38, "resolution": [512, 512]},
    "environment": {"type": "file", "file": "spectral/low-sun.hdr"},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.5046, 0.0042]}},
      "floor": {"type": "diffuse", "reflectance": 0.8}
    },
    "objects": [
      {"name": "sphere", "shape": {"type": "sphere", "radius": 1}, "material": "glass",
       "transform": {"translate": [0, 1.0001, 0]}},
      {"name": "floor", "shape": {"type": "quad", "size": [40, 1, 40]}, "material": "floor"}
    ]
  }
})";

} // namespace

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 16,
    .plan = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
        -> std::unique_ptr<plan::Plan> { return std::make_unique<EnvironmentPlan>(make_plan(preset, scene, bvh)); },
    .job =
        [](const preset::Preset& preset, const scene::Scene&, const scene::Bvh&, const plan::Plan& plan,
           const mpi::RankContext& context) {
          return make_job(preset, dynamic_cast<const EnvironmentPlan&>(plan), context);
        },
    .reference = [](const preset::Preset& preset, int) { return preset.reference->settings.value_or(preset.settings); },
    .checks = closed_forms,
    .adoptable = adoptable,
    .introduction =
        {.example = {.preset = "environment/ball",
                     .title = "Caustics under a sky",
                     .sentence =
                         "An object of glass is baked once. Then its caustics follow while the sky, the camera and the "
                         "floor are turned and moved.",
                     .run = "a glass ball under a picture of the sky"},
         .new_scene = {.preset = new_scene, .what = "A glass sphere under a sky"},
         .badge = {62, 104, 84}}};

bool adoptable(const preset::Preset& before, const preset::Preset& now) {
  const auto may_be_lit = [](const preset::Preset& preset) {
    return preset.scene.environment || !preset.scene.lights.empty();
  };
  if (before.scene.camera.resolution != now.scene.camera.resolution ||
      before.scene.objects.size() != now.scene.objects.size() || may_be_lit(before) != may_be_lit(now))
    return false;
  // Objects baked together may not move against each other.
  const auto is_caster = [&](const preset::Object& object) { return casts(before, object); };
  const std::vector<preset::Object>& objects = before.scene.objects;
  const bool alone = std::ranges::count_if(objects, is_caster) == 1;
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (!alone && is_caster(objects[i]) && objects[i].transform != now.scene.objects[i].transform) return false;
  // Weights of states may move between the steps that are baked.
  const preset::Preset deformed = with_weights_of(before, now);
  if (deformed != before && !mixes_alike(before, deformed)) return false;
  preset::Preset same = with_view_of(deformed, now);
  same.scene.environment = now.scene.environment;
  same.scene.lights = now.scene.lights;
  same = with_places_of(same, now);
  Settings& s = settings(same);
  const Settings& n = settings(now);
  s.occlusion = n.occlusion;
  s.cast = n.cast;
  s.extinction = n.extinction;
  s.albedo = n.albedo;
  s.phase = n.phase;
  s.anisotropy = n.anisotropy;
  return same == now;
}

} // namespace nephroid::environment
