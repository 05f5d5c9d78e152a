// SPDX-License-Identifier: Apache-2.0
// Spectral differentials, the part that depends on wavelength alone: along which parameter s a splat is stretched, and where each
// wavelength lies on it (kernels/tracing/differential.h has the derivatives, kernels/spectral/stretch.h the splats).
//
// Where all glass that disperses follows one curve, s is its index of refraction n. A path's place is a much straighter function of n than
// of the wavelength, and wavelengths that share an n share a place, however far apart they are, so a cluster of an anomalous curve
// is stretched as a whole. Where there are several curves, s is the wavelength in nm, and clusters are split into runs of neighbours.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::tracing {

/// none: no glass bends two wavelengths differently, so there is nothing to stretch.
enum class StretchParameter { none, index, wavelength };

StretchParameter stretch_parameter(const scene::Scene& scene);

/// The clusters, cut into runs of neighbouring wavelengths where they are none; ordered by their smallest wavelength.
std::vector<std::vector<int>> split_into_runs(const std::vector<std::vector<int>>& clusters);

/// All in float4 for the device, w unused. s is counted from 580 nm, so that differences are exact in single precision.
struct StretchTables {
  std::vector<shared::float4> place; ///< [401]: s; s of the wavelength 1 nm below; 1 nm above
  std::vector<shared::float4> span;  ///< [cluster]: s of a path at the cluster's mean index; lowest and highest s of its wavelengths' light
  std::vector<float> index_slope;    ///< [cluster][material]: dn/ds
};

/// For clusters of WavelengthTables: lit says which wavelengths stay in them. Light between two wavelengths is interpolated linearly: each
/// of the 401 has a tent of +-1 nm, whose arms end where the neighbours are; beyond 380 and 780 nm the curve goes on straight. An arm
/// across a jump of the curve (more than 8 times the steps on both sides of it) has length 0: nothing lies between.
StretchTables make_stretch_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit);

} // namespace nephroid::tracing
