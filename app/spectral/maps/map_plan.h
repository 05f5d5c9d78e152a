// SPDX-License-Identifier: Apache-2.0
// Whether a run has photon maps, why, and what memory they take.
#pragma once
#include "plan/plan.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/settings.h"
#include "spectral/tables/run_tables.h"

#include <cstdint>
#include <vector>

namespace nephroid::spectral {

struct MapPlan {
  plan::Pass pass;                          ///< "photon maps"
  std::vector<plan::PlannedBuffer> buffers; ///< of MapStage or SppmStage; none where it does not run
};

/// Paths from the eye that a pixel has in a pass of MapStage, 1..64: those that meet glass or a mirror first, which go on, are a third as
/// many in the whole picture as there are photons, so that neither takes most of the time and neither most of the noise.
unsigned eye_paths_a_pass(const scene::Scene& scene, const scene::Bvh& bvh, unsigned photons_per_pass);

/// caustics: whether there are any to estimate, by splats or maps. film_bytes: of one film. leave_out: maps where nothing needs them.
/// Throws bad_input at FILE#/scene/objects for more objects than photons in so many clusters can tell apart.
MapPlan plan_maps(const Settings& settings, const scene::Scene& scene, const RunTables& tables, bool caustics, std::uint64_t film_bytes,
                  bool leave_out);

} // namespace nephroid::spectral
