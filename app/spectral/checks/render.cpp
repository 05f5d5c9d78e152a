// SPDX-License-Identifier: Apache-2.0
#include "spectral/checks/render.h"

#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/engine.h"

#include <algorithm>

namespace nephroid::check {
namespace {

constexpr int stack = 64; ///< entries; more than any tree here needs

/// What a program is built for is the most that any scene here needs.
void share_programs(compute::Defines& defines)
{
  const auto at_least = [&](const char* name, int value) { defines[name] = std::to_string(std::max(std::stoi(defines[name]), value)); };
  at_least("NEPHROID_BVH_STACK", stack);
  at_least("NEPHROID_ATTENUATORS", 1);
  at_least("NEPHROID_ELLIPSOIDS", 1);
}

} // namespace

spectral::RunTables device_tables(const preset::Preset& preset)
{
  const scene::Scene scene = scene::load_scene(preset);
  return spectral::make_lit_tables(preset, scene, scene::build_bvh(scene.geometry), {});
}

job::Snapshot render(preset::Preset preset, const compute::Context& context)
{
  spectral::settings(preset).max_surfaces = 64;
  tracing::LeaveOut leave_out;
  leave_out.light_types = leave_out.mirrors = leave_out.bending = leave_out.attenuation = leave_out.smooth_normals = false;
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  spectral::RunPlan plan = spectral::make_plan(preset, scene, bvh, leave_out);
  share_programs(plan.defines);
  const auto job = spectral::make_job(preset, scene, bvh, plan, context);
  while (!job->finished()) job->step();
  return job->snapshot();
}

} // namespace nephroid::check
