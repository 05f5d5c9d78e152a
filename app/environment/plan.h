// SPDX-License-Identifier: Apache-2.0
// What engine 2 runs for a preset and what it leaves out.
#pragma once
#include "environment/bake/baker.h"
#include "environment/view/render_task.h"
#include "photons/plan.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace nephroid::environment {

struct EnvironmentPlan : plan::Plan {
  std::shared_ptr<const BakeTask> task;
  std::uint64_t key = 0;                    ///< of the bake
  std::filesystem::path bake_file;          ///< where it is kept
  bool bakes = true;                        ///< false: the file is there and looks right
  std::shared_ptr<const RenderTask> render; ///< null where there is no light: then only the bake is shown
  std::optional<photons::RunPlan> photons;  ///< where there is light, and photons join the spheres
};

/// bvh: of the scene. Throws bad_input as make_task and make_render_task.
EnvironmentPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

} // namespace nephroid::environment
