// SPDX-License-Identifier: Apache-2.0
// Settings of photons and paths from the eye; engine 1's section "spectral". describe_settings.h explains each choice.
#pragma once
#include <optional>

namespace nephroid::photons {

/// How much a wavelength matters (4.15), where Settings::effort asks for it.
struct Importance {
  enum class Cluster { maximum, mean };
  Cluster cluster = Cluster::maximum; ///< which of its wavelengths stands for a cluster (the thesis takes the maximum)
  bool geometry = true;               ///< weigh materials by how much of them the caustic objects see
  bool operator==(const Importance&) const = default;
};

/// Progressive photon mapping (Hachisuka and Jensen 2009).
struct Sppm {
  std::optional<double> radius; ///< radius of the first pass, in length units; default: by the camera's pixels
  double alpha = 2.0 / 3; ///< part of each pass's photons that is kept; the smaller, the faster the radius shrinks
  bool operator==(const Sppm&) const = default;
};

struct Settings {
  enum class Method { optimal, thesis, brute_force };
  enum class Estimator { automatic, points, splat, tiles, sppm }; ///< RunPlan never has automatic
  enum class Effort { automatic, power, equal, importance, radziszewski, variance, random };
  enum class Smoothing { automatic, on, off };
  Method method = Method::optimal;
  double threshold_deg = 0.05; ///< alpha: the largest change of the refraction angle inside a cluster
  int step_nm = 1;             ///< brute_force: number of neighbouring wavelengths that share a path
  Estimator estimator = Estimator::automatic;
  Effort effort = Effort::automatic;
  Importance importance;
  bool jitter = true; ///< each path takes one wavelength of its cluster (with maps: one that its pass shares), so
                      ///< clusters leave no bias
  bool low_discrepancy = true; ///< photons leave the lights by a scrambled Sobol sequence
  Smoothing smoothing = Smoothing::automatic;
  bool relight = false; ///< keeps a layer for each cluster, so that a light's spectrum can change without a new run
  int photons_per_pass = 1 << 18; ///< photons sent towards the caustic objects in one pass; sppm: for each cluster
  int indirect_photons_per_pass = 1 << 18; ///< photons of the layer "indirect" in one pass
  std::optional<int> pixel_samples;        ///< most samples of a pixel without glass and mirrors; RunPlan has a value
  int max_surfaces = 256;                  ///< interfaces a path may meet before it is counted as lost
  Sppm sppm;
  bool direct = true;  ///< layer: light that reaches a diffuse surface unbent
  bool caustic = true; ///< layer: light that met glass or a mirror, then one diffuse surface
  /// Layer: light that met a diffuse surface before the last one. Nothing: where diffuse surfaces can see each other;
  /// RunPlan has a value.
  std::optional<bool> indirect;
  bool background = true; ///< layer: the environment
  bool operator==(const Settings&) const = default;
};

} // namespace nephroid::photons
