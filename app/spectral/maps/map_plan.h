// SPDX-License-Identifier: Apache-2.0
// Whether a run has photon maps, why, what memory they take, and how far around a visible point photons are gathered: the first radius,
// and how it shrinks from pass to pass.
#pragma once
#include "plan/plan.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/settings.h"
#include "spectral/tables/run_tables.h"

#include <cstdint>
#include <string>
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

/// spectral.sppm.radius; without, twice what a pixel covers at the distance of the scene's middle (a quarter of the scene's
/// radius for a camera that is nearer). In scene units.
double first_map_radius(const Settings& settings, const scene::Scene& scene);

/// What the plan says of a spectral.sppm.radius that loses the caustics: wider than 32 pixels or than the whole scene, or below 1/16 pixel,
/// where a pass of as many photons as pixels finds one in some hundred pixels; and of an alpha that makes it so small by the first photons
/// that a pixel of the estimator sppm finds. Empty for any other.
std::string map_radius_note(const Settings& settings, const scene::Scene& scene);

/// What the first radius is multiplied with in pass p (from 0): r_(p+1)^2 = r_p^2 (p + alpha) / (p + 1), counted from 1 (Knaus and Zwicker
/// 2011, "Progressive photon mapping: a probabilistic approach", (15)). Squares of radii then fall as p^(alpha - 1): the bias, which is
/// in proportion, vanishes, and so does the variance of the mean of all passes, as p^-alpha. alpha in (0, 1).
double map_radius_factor(std::int64_t pass, double alpha);

} // namespace nephroid::spectral
