// SPDX-License-Identifier: Apache-2.0
// The photons that engine 2 comes to: those of engine 1, for the layer "caustic" alone.
#pragma once
#include "photons/job.h"
#include "communicator/rank_context.h"

namespace nephroid::environment {

/// preset: of this engine. scene: with the environment as a light. Throws as photons::make_plan.
photons::RunPlan plan_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

/// plan: of the same preset and scene. Null where there are no caustics. Throws as photons::make_job.
std::unique_ptr<photons::PhotonJob> make_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                           const photons::RunPlan& plan, const mpi::RankContext& context);

} // namespace nephroid::environment
