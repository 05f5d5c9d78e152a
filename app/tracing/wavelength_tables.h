// SPDX-License-Identifier: Apache-2.0
// What kernels know of wavelengths: indices of refraction, losses, and the light of clusters of wavelengths.
#pragma once
#include "kernels/tracing/scene_table_types.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::tracing {

// Items of the tables of kernels/tracing/scene_table_types.h.
using shared::DeviceLight, shared::DeviceMaterial, shared::DeviceObject, shared::DevicePrimitive, shared::DeviceTarget,
    shared::float4;

/// Everything that depends on wavelength, for `clusters` of the 401 wavelengths.
struct WavelengthTables {
  std::vector<std::vector<int>> clusters; ///< wavelength indices of each, without those that are left out
  WAVELENGTH_TABLES(TABLE_VECTOR)
  COLOUR_TABLES(TABLE_VECTOR)
  bool clusters_spread = false;           ///< whether n differs inside any cluster
  std::vector<std::vector<double>> share; ///< [light][cluster]: of the light's power
  std::vector<std::vector<double>>
      seen; ///< [light][cluster]: what the eye makes of that share, (X + Y + Z) / 3: see worth() in scales.h
  int attenuator_count = 0, reflector_count = 0;
};

/// a for each wavelength [401], where exp(-a s) of the light is left. In glass that absorbs (Beer and Lambert) a = 4 pi
/// k / lambda in 1/m, and s is metres. On a mirror a = -ln(reflectance), and s is the number of reflections. Empty for
/// a material that takes nothing away.
std::vector<double> loss_coefficients(const scene::Material& material);

/// For `lights` of the scene, of which the environment is the last; fills materials[i].type, reflector and attenuator
/// and every table. Only materials that an object uses get rows. lit: which wavelengths stay in the clusters; a
/// cluster's index of refraction is the mean over all that it had.
WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials);

/// Spectral differentials, the part that depends on wavelength alone: along which parameter s a splat is stretched, and
/// where each wavelength lies on it (kernels/tracing/differential.h has the derivatives, kernels/photons/stretch.h the
/// splats).
///
/// Where all glass that disperses follows one curve, s is its index of refraction n. A path's place is a much
/// straighter function of n than of the wavelength, and wavelengths that share an n share a place, however far apart
/// they are, so a cluster of an anomalous curve is stretched as a whole. Where there are several curves, s is the
/// wavelength in nm, and clusters are split into runs of neighbours. none: no glass bends two wavelengths differently,
/// so there is nothing to stretch.
enum class StretchParameter { none, index, wavelength };

StretchParameter stretch_parameter(const scene::Scene& scene);

/// The clusters, cut into runs of neighbouring wavelengths where they are none; ordered by their smallest wavelength.
std::vector<std::vector<int>> split_into_runs(const std::vector<std::vector<int>>& clusters);

/// s is counted from 580 nm, so that differences are exact in single precision.
struct StretchTables {
  STRETCH_TABLES(TABLE_VECTOR)
};

/// For clusters of WavelengthTables: lit says which wavelengths stay in them. Light between two wavelengths is
/// interpolated linearly: each of the 401 has a tent of +-1 nm, whose arms end where the neighbours are; beyond 380 and
/// 780 nm the curve goes on straight. An arm across a jump of the curve (more than 8 times the steps on both sides of
/// it) has length 0: nothing lies between.
StretchTables make_stretch_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                                  const std::vector<bool>& lit);

} // namespace nephroid::tracing
