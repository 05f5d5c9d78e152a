// SPDX-License-Identifier: Apache-2.0
#include "spectral/engine.h"

#include "spectral/checks/render.h"

#include <algorithm>

namespace nephroid::spectral {
namespace {

/// Settings of a reference: each wavelength alone, paths at least the default's. What changes no expected value (the
/// threshold, photons a pass) has its default, so that runs that differ only in it share a reference.
photons::Settings brute_force(const photons::Settings& settings) {
  photons::Settings exact;
  exact.method = photons::Settings::Method::brute_force;
  exact.step_nm = 1;
  exact.max_surfaces = std::max(exact.max_surfaces, settings.max_surfaces);
  // Photon maps have a radius, and the estimator sppm keeps to them: where splats can replace them, they are the truth.
  using Estimator = photons::Settings::Estimator;
  if (settings.estimator == Estimator::splat) exact.estimator = Estimator::splat;
  exact.direct = settings.direct;
  exact.caustic = settings.caustic;
  exact.indirect = settings.indirect;
  exact.background = settings.background;
  return exact;
}

preset::Settings reference(const preset::Preset& preset, int passes) {
  const auto& recipe = preset.reference->settings;
  preset::Settings settings = recipe ? *recipe : preset.settings;
  photons::Settings& s = settings.as<photons::Settings>();
  const photons::Settings& run = preset.settings.as<photons::Settings>();
  if (!recipe) s = brute_force(s);
  if (!s.indirect) s.indirect = run.relight ? false : run.indirect; // as the run's (photons/capabilities.h)
  s.smoothing = photons::Settings::Smoothing::off;                  // it would be a bias
  if (s.effort == photons::Settings::Effort::automatic) s.effort = photons::Settings::Effort::power;
  s.pixel_samples = std::max(s.pixel_samples.value_or(0), passes); // the direct layer converges like the caustic layer
  return settings;
}

std::vector<check::Check> closed_forms() {
  std::vector<check::Check> checks;
  for (const auto subject :
       {check::table_checks, check::radiometry_checks, check::refraction_checks, check::material_checks})
    for (check::Check& check : subject()) checks.push_back(std::move(check));
  return checks;
}

// Cauchy's formula with the two terms that fit N-BK7: the scene needs no file.
constexpr const char* new_scene = R"({
  "name": "untitled", "description": "A glass sphere on a floor under a lamp", "engine": "spectral",
  "unit": "cm", "white": 6,
  "scene": {
    "camera": {"position": [2, 5, 8], "target": [0.6, 0.4, 0], "fov_deg": 36, "resolution": [512, 512]},
    "materials": {
      "glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.5046, 0.0042]}},
      "floor": {"type": "diffuse", "reflectance": 0.8}
    },
    "objects": [
      {"name": "floor", "shape": {"type": "quad", "size": [24, 1, 24]}, "material": "floor"},
      {"name": "sphere", "shape": {"type": "sphere", "radius": 1}, "material": "glass",
       "transform": {"translate": [0, 1.5, 0]}}
    ],
    "lights": [{"type": "point", "spectrum": "D65", "power_w": 10, "position": [-4, 6, -2]}]
  },
  "stop": {"passes": 64}
})";

} // namespace

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 13,
    .plan = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
        -> std::unique_ptr<plan::Plan> { return std::make_unique<photons::RunPlan>(make_plan(preset, scene, bvh)); },
    .job = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const plan::Plan& plan,
              const mpi::RankContext& context) -> std::unique_ptr<job::Job> {
      return photons::make_job(preset, scene, bvh, dynamic_cast<const photons::RunPlan&>(plan), context);
    },
    .reference = reference,
    .checks = closed_forms,
    .adoptable = adoptable,
    .introduction = {.example = {.preset = "first-light",
                                 .title = "Spectral caustics",
                                 .sentence = "Glass parts light into its colours. All 401 wavelengths are rendered; "
                                             "those that refract alike share their paths.",
                                 .run = "the same as files, in out/first-light"},
                     .new_scene = {.preset = new_scene, .what = "A glass sphere on a floor under a lamp"},
                     .badge = {70, 84, 120}}};

photons::RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh) {
  return make_plan(preset, scene, bvh, {.all = preset.leave_out});
}

photons::RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                           const tracing::LeaveOut& leave_out) {
  photons::RunPlan plan = photons::make_plan(preset, settings(preset), scene, bvh, leave_out);
  plan.engine = "spectral";
  const auto& environment = preset.scene.environment;
  if (environment && !environment->lights && scene.lights.empty() && !preset.scene.objects.empty())
    plan.notes.push_back(
        "nothing lights the scene: it has no lamp, and its environment is only seen; to be lit by that: "
        "--set scene.environment.lights=true");
  return plan;
}

bool adoptable(const preset::Preset& before, const preset::Preset& now) {
  if (!settings(before).relight || before.scene.lights.size() != now.scene.lights.size()) return false;
  preset::Preset same = now;
  same.name = before.name;
  same.description = before.description;
  same.white = before.white;
  for (std::size_t i = 0; i < same.scene.lights.size(); ++i) {
    const preset::Light& light = before.scene.lights[i];
    same.scene.lights[i].spectrum = light.spectrum;
    same.scene.lights[i].power_w = light.power_w;
    same.scene.lights[i].irradiance_w_m2 = light.irradiance_w_m2;
  }
  return same == before;
}

} // namespace nephroid::spectral
