// SPDX-License-Identifier: Apache-2.0
#include "photons/stage_context.h"

#include "photons/pixel_surfaces.h"
#include "photons/plan.h"
#include "photons/plan_part.h"

#include <numeric>

namespace nephroid::photons {
namespace {

PixelLists make_pixel_lists(const compute::Context& context, const scene::Scene& scene) {
  PixelLists lists;
  lists.count = static_cast<std::uint32_t>(scene.camera.pixels());
  lists.glass = glass_pixels(scene);
  lists.may_show_glass.assign(lists.count, false);
  for (const std::uint32_t pixel : lists.glass) lists.may_show_glass[pixel] = true;
  std::vector<std::uint32_t> pixels(lists.count);
  std::iota(pixels.begin(), pixels.end(), 0);
  pixels.insert(pixels.end(), lists.glass.begin(), lists.glass.end());
  lists.on_device = compute::Buffer(context, "pixels", pixels);
  return lists;
}

} // namespace

StageContext make_stage_context(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                const RunPlan& plan, const mpi::RankContext& context) {
  StageContext world{tracing::make_world(context, scene, bvh, plan.tables, plan.defines, preset.seed), plan.tables,
                     preset.white.value_or(1),
                     scene.camera.meter     ? meter_replicates
                     : plan.estimates_error ? 2u
                                            : 1u};
  world.energy = world.zeroed("energy", OUTCOME_COUNT);
  world.pixels = make_pixel_lists(context, scene);
  world.emitters = compute::Buffer(context, "emitters", plan.tables.emitters);
  return world;
}

} // namespace nephroid::photons
