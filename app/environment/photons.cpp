// SPDX-License-Identifier: Apache-2.0
#include "environment/photons.h"

#include "environment/settings.h"

namespace nephroid::environment {
namespace {

/// It is this engine's to stop, and the halves are what photons are mixed by.
preset::Preset without_stop(preset::Preset preset)
{
  preset.stop = {};
  preset.measure.estimate = true;
  return preset;
}

} // namespace

photons::RunPlan plan_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
{
  photons::Settings photons;
  photons.direct = photons.background = false;
  photons.caustic = settings(preset).cast;
  photons::RunPlan plan = photons::make_plan(without_stop(preset), photons, scene, bvh, {.all = preset.leave_out});
  plan.has_previews = false; // the spheres make it
  return plan;
}

std::unique_ptr<photons::PhotonJob> make_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                           const photons::RunPlan& plan, const mpi::RankContext& context)
{
  if (plan.layers == 0) return nullptr;
  return photons::make_job(without_stop(preset), scene, bvh, plan, context);
}

} // namespace nephroid::environment
