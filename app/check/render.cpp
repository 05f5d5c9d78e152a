// SPDX-License-Identifier: Apache-2.0
#include "check/render.h"

#include "base/error.h"
#include "optics/colour.h"
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
}

} // namespace

job::Snapshot render(preset::Preset preset, const compute::Context& context)
{
  preset.spectral.max_surfaces = 64;
  preset::LeaveOut& leave_out = preset.spectral.leave_out;
  leave_out.light_types = leave_out.mirrors = leave_out.bending = leave_out.attenuation = leave_out.smooth_normals = false;
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  plan::Plan plan = spectral::make_plan(preset, scene, bvh);
  share_programs(plan.defines);
  const auto job = spectral::make_job(preset, scene, bvh, plan, context);
  while (!job->finished()) job->step();
  return job->snapshot();
}

const job::Layer& layer(const job::Snapshot& snapshot, const std::string& name)
{
  for (const job::Layer& candidate : snapshot.picture->layers)
    if (candidate.name == name) return candidate;
  throw failed("check", "no layer " + name);
}

double luminance(const job::Layer& layer, int width, int row, int column)
{
  const std::size_t i = 3 * static_cast<std::size_t>(row * width + column);
  return optics::linear_srgb_to_xyz({layer.rgb[i], layer.rgb[i + 1], layer.rgb[i + 2]})[1];
}

} // namespace nephroid::check
