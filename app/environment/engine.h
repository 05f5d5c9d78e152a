// SPDX-License-Identifier: Apache-2.0
// Engine 2, caustics under environment light (thesis chapter 3): what glass and mirrors do to light is baked once, from a few directions.
#pragma once
#include "compute/compute.h"
#include "engine/engine.h"
#include "environment/bake/baker.h"
#include "environment/photons.h"
#include "environment/settings.h"
#include "environment/view/render_task.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace nephroid::environment {

extern const engine::Engine engine;

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

/// Reads the bake where the plan has one, else bakes; then renders until the preset's stop. Where there is no light the bake is all, and a
/// pass of the stop is a direction. Throws failed where the device has not enough memory.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const EnvironmentPlan& plan, const compute::Context& context);

/// Whether a job of `before` goes on with `now`, with the same bake: only the camera, light, where objects stand, the medium,
/// `cast`, the segmentation, white, name or description differ.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::environment
