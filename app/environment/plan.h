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
  std::uint64_t key = 0;                    ///< the bake's key
  std::filesystem::path bake_file;          ///< the file that keeps the bake
  bool bakes = true;                        ///< false: the file is there and looks right
  std::shared_ptr<const RenderTask> render; ///< null where there is no light: then only the bake is shown
  std::optional<photons::RunPlan> photons;  ///< empty where there is no light, or photons do not join
};

/// bvh: the scene's. Throws bad_input as make_task and make_render_task do.
EnvironmentPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

} // namespace nephroid::environment
