// SPDX-License-Identifier: Apache-2.0
// What kernels know of wavelengths: indices of refraction, losses, and the light of clusters of wavelengths.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::tracing {

// Items of the tables of kernels/tracing/scene_table_types.h.
using shared::DeviceLight, shared::DeviceMaterial, shared::DeviceMeterChart, shared::DeviceObject,
    shared::DevicePrimitive, shared::DeviceTarget, shared::DeviceTexture, shared::float4, shared::ushort;

/// Everything that depends on wavelength, for `clusters` of the 401 wavelengths.
struct WavelengthTables {
  std::vector<std::vector<int>> clusters; ///< [cluster]: wavelength indices, without those left out
  WAVELENGTH_TABLES(TABLE_VECTOR)
  COLOUR_TABLES(TABLE_VECTOR)
  bool clusters_spread = false;           ///< whether n, or what glass reflects, differs inside any cluster
  std::vector<std::vector<double>> share; ///< [light][cluster]: part of the light's power
  std::vector<std::vector<double>> seen;  ///< [light][cluster]: what the eye makes of that: worth() in scales.h
  bool takes_light = false, colours_light = false; ///< scatter::DeviceMaterials
  int reflector_count = 0;
};

/// Fills every table, and materials. Only materials that an object uses get rows.
/// lights: the environment is last. lit: which wavelengths stay in the clusters, whose n is the mean over all.
WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials);

/// What the film adds up of each wavelength: what the eye makes of it, or a meter.
const optics::ColourMatching& response_of(const scene::Scene& scene);

/// The parameter s along which spectral differentials stretch a splat. It depends on wavelength alone
/// (kernels/transport/differential.h has the derivatives, kernels/photons/stretch.h the splats).
///
/// Where all glass that disperses follows one curve, s is its index of refraction n. A path's place is a much
/// straighter function of n than of the wavelength, and wavelengths that share an n share a place, however far apart
/// they are, so a cluster of an anomalous curve is stretched as a whole. Where there are several curves, s is the
/// wavelength in nm, and clusters are split into runs of neighbours. none: no glass disperses.
enum class StretchParameter { none, index, wavelength };

StretchParameter stretch_parameter(const scene::Scene& scene);

/// The clusters, cut into runs of neighbouring wavelengths and ordered by their smallest wavelength.
std::vector<std::vector<int>> split_into_runs(const std::vector<std::vector<int>>& clusters);

/// s is counted from 580 nm, so that differences are exact in single precision.
struct StretchTables {
  STRETCH_TABLES(TABLE_VECTOR)
};

/// For clusters of WavelengthTables; lit: which wavelengths stay in them. Light between two wavelengths is interpolated
/// linearly: each of the 401 has a tent of +-1 nm, whose arms end at the neighbours. Beyond 380 and 780 nm the curve
/// goes on straight. An arm across a jump of the curve (8 times the steps on both sides) has length 0.
StretchTables make_stretch_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                                  const std::vector<bool>& lit);

} // namespace nephroid::tracing
