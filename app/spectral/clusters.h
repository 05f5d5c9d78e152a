// SPDX-License-Identifier: Apache-2.0
// Wavelength clusters: which of the 401 wavelengths may share one path (thesis 4.1.1). No OpenCL here.
#pragma once
#include "optics/wavelength.h"

#include <span>
#include <vector>

namespace nephroid::spectral {

enum class ClusterMethod { optimal, thesis, brute_force };

struct Cluster {
  std::vector<int> wavelengths;  ///< indices 0..400 in the order of falling n
  double n_mean = 1;             ///< of the curve that was clustered
  double theta_deg2 = 0;         ///< change of the refraction angle inside the cluster, integrated over 0..89 degrees (4.4)
};

struct Clustering {
  ClusterMethod method = ClusterMethod::optimal;
  double threshold_deg = 0;
  double total_theta_deg2 = 0;
  std::vector<Cluster> clusters; ///< by falling n
};

/// threshold_deg: alpha in (0, 90). n: on the 401 wavelengths, finite and > 0.
Clustering cluster_wavelengths(const optics::Spectrum& n, double threshold_deg, ClusterMethod method);

/// The coarsest partition that is finer than each of the given ones: wavelengths stay together where they are together in all
/// of them. One group of wavelength indices a cluster, ordered by its smallest wavelength; an empty input gives one group of all.
std::vector<std::vector<int>> common_refinement(std::span<const Clustering> clusterings);

} // namespace nephroid::spectral
