// SPDX-License-Identifier: Apache-2.0
// What each way of estimating light can do, against what a scene and the other settings ask for.
#pragma once
#include "photons/settings.h"
#include "plan/plan.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace nephroid::photons {

/// The settings that a run has, of those that are wanted.
struct Agreed {
  Settings settings;           ///< the estimator is not automatic, and indirect has a value
  plan::Decision tiles;        ///< whether photons are tiles, and why
  std::string why_no_indirect; ///< why settings.indirect is false
  std::string why_no_layers;   ///< why spectral.relight cannot be done, wanted or not; empty where it can
  /// A sentence for each field that is not as it is wanted: what cannot do what, and what is done in its place.
  std::vector<std::string> notes;
};

Agreed agree(const Settings& wanted, const scene::Scene& scene);

/// Why splats cannot be stretched along the wavelengths of a cluster, whatever the settings; empty where they can.
std::string why_no_differentials(const scene::Scene& scene);

} // namespace nephroid::photons
