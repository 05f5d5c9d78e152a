// SPDX-License-Identifier: Apache-2.0
#include "spectral/engine.h"

#include "spectral/checks/render.h"
#include "spectral/relight/layer_light.h"

#include <algorithm>

namespace nephroid::spectral {
namespace {

/// Every wavelength on its own, in steps of 1 nm whatever the run's are, and paths at least as long as by default. What changes no
/// expected value (the threshold, photons a pass, what is left out) is the default's, so that runs that differ in it alone share a
/// reference.
Settings brute_force(const Settings& settings)
{
  Settings exact;
  exact.method = Settings::Method::brute_force;
  exact.step_nm = 1;
  exact.max_surfaces = std::max(exact.max_surfaces, settings.max_surfaces);
  // Photon maps have a radius, and the estimator sppm keeps to them: where splats do, they are the truth.
  if (settings.estimator == Settings::Estimator::splat) exact.estimator = settings.estimator;
  exact.direct = settings.direct;
  exact.caustic = settings.caustic;
  exact.indirect = settings.indirect;
  exact.background = settings.background;
  return exact;
}

preset::Settings reference(const preset::Preset& preset, int passes)
{
  const auto& recipe = preset.reference->settings;
  preset::Settings settings = recipe ? *recipe : preset.settings;
  Settings& s = settings.as<Settings>();
  if (!recipe) s = brute_force(s);
  s.smoothing = Settings::Smoothing::off; // it would be a bias
  if (s.effort == Settings::Effort::automatic) s.effort = Settings::Effort::power;
  s.pixel_samples = std::max(s.pixel_samples, passes); // the direct layer as well converged as the caustic
  return settings;
}

std::vector<check::Check> closed_forms()
{
  std::vector<check::Check> checks;
  for (const auto subject : {check::spectral_checks, check::emission_checks, check::radiometry_checks, check::refraction_checks})
    for (check::Check& check : subject()) checks.push_back(std::move(check));
  return checks;
}

} // namespace

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 7,
    .plan = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh) -> std::unique_ptr<plan::Plan> {
      return std::make_unique<RunPlan>(make_plan(preset, scene, bvh));
    },
    .job = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const plan::Plan& plan,
              const compute::Context& context) { return make_job(preset, scene, bvh, dynamic_cast<const RunPlan&>(plan), context); },
    .reference = reference,
    .checks = closed_forms,
    .adoptable = only_relit};

} // namespace nephroid::spectral
