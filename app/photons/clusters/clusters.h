// SPDX-License-Identifier: Apache-2.0
// Wavelength clusters: which of the 401 wavelengths may share one path through one glass (thesis 4.1.1).
#pragma once
#include "optics/wavelength.h"
#include "photons/settings.h"

#include <span>
#include <vector>

namespace nephroid::photons {

/// thesis: bicubic patches and Algorithm 4.1 as printed; optimal: exact changes of angle.
using ClusterMethod = Settings::Method;

struct Cluster {
  std::vector<int> wavelengths; ///< indices 0..400 in the order of falling n
  double n_mean = 1;            ///< mean of n over the cluster
  double theta_deg2 = 0; ///< change of the refraction angle inside the cluster, integrated over 0..89 degrees (4.4)
};

struct Clustering {
  ClusterMethod method = ClusterMethod::optimal;
  double threshold_deg = 0;
  double total_theta_deg2 = 0;   ///< sum over the clusters: the change from the highest to the lowest n
  std::vector<Cluster> clusters; ///< by falling n
};

/// Sorts the wavelengths by falling n (equal n: by wavelength). Each has Theta, the change of angle to the next one. To
/// decide what may be merged, the last one gets the change of the one before it; the reported sums count the 400. A
/// cluster with several wavelengths has at most threshold_deg * 89 square degrees. Below n = 1, theta2 counts as 90
/// degrees beyond the critical angle, and Theta is exact with every method, for the patches' derivative is infinite at
/// that angle. threshold_deg is alpha, in (0, 90); n is finite and > 0. Throws bad_input otherwise.
Clustering cluster_wavelengths(const optics::Spectrum& n, double threshold_deg, ClusterMethod method);

/// The coarsest partition that is finer than each of the given ones, as indices, ordered by each group's smallest.
std::vector<std::vector<int>> common_refinement(std::span<const Clustering> clusterings);

/// Theta is the change of the refraction angle from one wavelength to the next, integrated over the angle of incidence
/// (thesis 4.4): once exactly, once by the thesis' bicubic patches. The angles of incidence end at 89 degrees, where
/// every index of refraction from 1 on still has a finite derivative.
inline constexpr int last_angle_deg = 89;

/// G(n), the integral over theta1 = 0..89 degrees of theta2 = asin(sin theta1 / n), in square degrees; n > 0.
double refraction_integral_deg2(double n);

/// n is falling and has at least two values. Returns a value >= 0 in square degrees for each of the n.size() - 1 steps.
std::vector<double> theta_exact(std::span<const double> n);
/// As theta_exact, by bicubic patches of 1 nm by 1 degree; exact where a patch would need a derivative at n < 1.
std::vector<double> theta_patches(std::span<const double> n);

} // namespace nephroid::photons
