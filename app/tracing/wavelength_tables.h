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

} // namespace nephroid::tracing
