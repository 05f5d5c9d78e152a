// SPDX-License-Identifier: Apache-2.0
#include "environment/engine.h"

namespace nephroid::environment {

constinit const engine::Engine engine{
    .settings = settings_type,
    .state_version = 6,
    .plan = [](const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh) -> std::unique_ptr<plan::Plan> {
      return std::make_unique<EnvironmentPlan>(make_plan(preset, scene, bvh));
    },
    .job = [](const preset::Preset& preset, const scene::Scene&, const scene::Bvh&, const plan::Plan& plan,
              const compute::Context& context) { return make_job(preset, dynamic_cast<const EnvironmentPlan&>(plan), context); },
    .reference = [](const preset::Preset& preset, int) { return preset.reference->settings.value_or(preset.settings); },
    .checks = closed_forms,
    .adoptable = adoptable};

} // namespace nephroid::environment
