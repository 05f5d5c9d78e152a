// SPDX-License-Identifier: Apache-2.0
// What engine 2 runs for a preset and what it leaves out.
#pragma once
#include "environment/bake/baker.h"
#include "environment/view/render_task.h"
#include "photons/plan.h"

#include <memory>
#include <optional>
#include <vector>

namespace nephroid::environment {

struct EnvironmentPlan : plan::Plan {
  std::shared_ptr<const BakeTask> task;     ///< of the object as it stands
  std::vector<PlannedBake> baked;           ///< of the shapes that it is between; of itself alone where it is on a step
  bool bakes = true;                        ///< false: their files are there and look right
  std::shared_ptr<const RenderTask> render; ///< null where there is no light: then only the bake is shown
  std::optional<photons::RunPlan> photons;  ///< empty where there is no light, or photons do not join
};

/// bvh: the scene's. Throws bad_input as make_task and make_render_task do.
EnvironmentPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

} // namespace nephroid::environment
