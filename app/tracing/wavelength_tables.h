// SPDX-License-Identifier: Apache-2.0
// What kernels know of wavelengths: indices of refraction, losses, and the light of clusters of wavelengths.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::tracing {

/// Everything that depends on wavelength, for `clusters` of the 401 wavelengths.
struct WavelengthTables {
  std::vector<std::vector<int>> clusters;        ///< wavelength indices of each, without those that are left out
  std::vector<int> cluster_first;                ///< cluster_count + 1
  std::vector<int> cluster_wavelengths;          ///< cluster after cluster
  std::vector<float> index_of_cluster;           ///< [cluster][material]: of refraction, mean over the cluster; 1 for what is no dielectric
  std::vector<float> index_of_wavelength;        ///< [401][material]
  std::vector<float> wavelength_cdf;             ///< [light, then all together][member of cluster_wavelengths]: see kernels/tracing/band.h
  bool clusters_spread = false;                  ///< whether n differs inside any cluster
  std::vector<float> coefficient;                ///< [attenuator][401]: 1/m, or -ln(reflectance) of a mirror
  std::vector<float> reflectance;                ///< [reflector][401]
  std::vector<shared::float4> light_xyz;         ///< [light][401]: share times (xbar, ybar, zbar), share; three rows of the environment
  std::vector<shared::float4> reflected_xyz;     ///< [row of light_xyz][cluster][reflector]; w: the share, as of a white one
  std::vector<shared::float4> reflected_xyz_all; ///< [row of light_xyz][reflector]
  std::vector<float> cluster_cdf;                ///< exact_cdf_from_zero: what paths through glass are worth in each cluster
  std::vector<std::vector<double>> share;        ///< [light][cluster]: of the light's power
  std::vector<std::vector<double>> seen; ///< [light][cluster]: what the eye makes of that share, (X + Y + Z) / 3: see worth() in scales.h
  int attenuator_count = 0, reflector_count = 0;
};

/// a for each wavelength [401], where exp(-a s) of the light is left. In glass that absorbs (Beer and Lambert) a = 4 pi k / lambda in 1/m,
/// and s is metres. On a mirror a = -ln(reflectance), and s is the number of reflections. Empty for a material that takes nothing away.
std::vector<double> loss_coefficients(const scene::Material& material);

/// For `lights` of the scene, of which the environment is the last; fills materials[i].type, reflector and attenuator and every table. Only
/// materials that an object uses get rows. lit: which wavelengths stay in the clusters; a cluster's index of refraction is the mean over
/// all that it had.
WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials);

/// Spectral differentials, the part that depends on wavelength alone: along which parameter s a splat is stretched, and where each
/// wavelength lies on it (kernels/tracing/differential.h has the derivatives, kernels/photons/stretch.h the splats).
///
/// Where all glass that disperses follows one curve, s is its index of refraction n. A path's place is a much straighter function of n than
/// of the wavelength, and wavelengths that share an n share a place, however far apart they are, so a cluster of an anomalous curve
/// is stretched as a whole. Where there are several curves, s is the wavelength in nm, and clusters are split into runs of neighbours.
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
