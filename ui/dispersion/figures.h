// SPDX-License-Identifier: Apache-2.0
// What a clustering means for a person: which stretches of the spectrum belong together, what it saves, how far it may bend light wrong.
#pragma once
#include "optics/wavelength.h"
#include "spectral/clusters/clusters.h"

#include <array>
#include <vector>

namespace nephroid::ui {

/// By how much the refraction angle differs inside a cluster: between the rays of its highest and its lowest n, which all go the way
/// of the mean. A cluster of one wavelength has none.
struct Spread {
  double mean_deg = 0;     ///< over the 401 wavelengths, each with its cluster's
  double greatest_deg = 0; ///< of all clusters
};

struct ClusterFigures {
  spectral::Clustering clustering;
  double saving = 1;  ///< 401 / clusters: how many times fewer paths than brute force
  Spread at_45;       ///< at an angle of incidence of 45 degrees
  Spread over_angles; ///< the mean over 0..89 degrees of incidence, which is what the threshold alpha is about
};

/// n: the curve that was clustered.
ClusterFigures figures_of(spectral::Clustering clustering, const optics::Spectrum& n);

/// Neighbouring wavelengths (indices 0..400, both ends included) of one cluster.
struct Band {
  int first = 0, last = 0;
  std::size_t cluster = 0;
};

/// The cluster of every wavelength.
std::array<std::size_t, optics::wavelength_count> cluster_of_wavelengths(const spectral::Clustering& clustering);
/// By rising wavelength. A cluster whose wavelengths are not neighbours has several.
std::vector<Band> bands_of(const spectral::Clustering& clustering);

} // namespace nephroid::ui
