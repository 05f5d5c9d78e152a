// SPDX-License-Identifier: Apache-2.0
// How the work of a pass is allocated to lights and clusters (Settings::effort).
#pragma once
#include "photons/settings.h"
#include "plan/plan.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/wavelength_tables.h"

#include <vector>

namespace nephroid::photons {

/// How photons are allocated to clusters, and which share of the iterations each cluster has.
struct ClusterShares {
  std::vector<double> photons;    ///< [light][cluster] flat: weights of a pass's photons; 0 only where it is dark
  std::vector<double> importance; ///< [cluster]: 0..1, the largest 1: share of iterations; above 0 where lit
};

/// watts[light] is the power of each light of `tables` towards its targets. The efforts `power`, and at first
/// `variance` and `automatic`, go by what the eye makes of the watts: (X + Y + Z) / 3 of the cluster's share, plus a
/// twentieth of the share. `equal` and `random` treat every cluster that has light alike. `importance` and
/// `radziszewski` go by cluster_importance. Within a cluster the lights' parts are in proportion to their watts in it.
/// Where no caustic can be, every cluster has 1. Throws bad_input as wavelength_importance does.
ClusterShares make_cluster_shares(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                                  const std::vector<double>& watts, const tracing::WavelengthTables& tables);

/// The plan's pass "importance": how photons are allocated, and how much of equal work is left.
plan::Decision effort_decision(const Settings& settings, const std::vector<double>& importance);

} // namespace nephroid::photons
