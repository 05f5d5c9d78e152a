// SPDX-License-Identifier: Apache-2.0
// How the work of a pass is allocated to lights and clusters (Settings::effort). No OpenCL here.
#pragma once
#include "photons/settings.h"
#include "plan/plan.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/wavelength_tables.h"

#include <vector>

namespace nephroid::photons {

/// How photons are allocated to clusters, and what share of the iterations each has.
struct ClusterShares {
  std::vector<double>
      photons; ///< [light][cluster] flat: photons of a pass are allocated in proportion; 0 only where there is no light
  std::vector<double>
      importance; ///< [cluster]: 0..1, the largest 1, above 0 where there is light: part of the iterations that it has
};

/// watts: of each light of `tables` towards its targets.
/// power, and variance and automatic to begin with: by what the eye makes of the watts, (X + Y + Z) / 3 of the
/// cluster's share, plus a twentieth of the share. equal: every cluster that has light the same. importance,
/// radziszewski: by cluster_importance. random: as equal. Within a cluster lights have their part by their watts in it.
/// Where no caustic can be (no light, nothing that throws or receives one) importance is not asked for: every cluster
/// has 1. Throws bad_input as wavelength_importance does.
ClusterShares make_cluster_shares(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                                  const std::vector<double>& watts, const tracing::WavelengthTables& tables);

/// The plan's pass "importance": how photons are allocated to clusters, and what of equal work that leaves. importance:
/// ClusterShares::importance.
plan::Pass effort_pass(const Settings& settings, const std::vector<double>& importance);

} // namespace nephroid::photons
