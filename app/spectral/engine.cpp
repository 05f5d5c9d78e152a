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
  Settings made;
  made.method = Settings::Method::brute_force;
  made.step_nm = 1;
  made.max_surfaces = std::max(made.max_surfaces, settings.max_surfaces);
  // Photon maps have a radius, and the estimator sppm keeps to them: where splats do, they are the truth.
  if (settings.estimator == Settings::Estimator::splat) made.estimator = settings.estimator;
  made.direct = settings.direct;
  made.caustic = settings.caustic;
  made.indirect = settings.indirect;
  made.background = settings.background;
  return made;
}

preset::Settings reference(const preset::Preset& preset, int passes)
{
  const auto& recipe = preset.reference->settings;
  preset::Settings made = recipe ? *recipe : preset.settings;
  Settings& s = made.as<Settings>();
  if (!recipe) s = brute_force(s);
  s.smoothing = Settings::Smoothing::off; // it would be a bias
  if (s.effort == Settings::Effort::automatic) s.effort = Settings::Effort::power;
  s.pixel_samples = std::max(s.pixel_samples, passes); // the direct layer as well converged as the caustic
  return made;
}

std::vector<check::Check> closed_forms()
{
  std::vector<check::Check> all;
  for (const auto subject : {check::spectral_checks, check::emission_checks, check::radiometry_checks, check::refraction_checks})
    for (check::Check& check : subject()) all.push_back(std::move(check));
  return all;
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
