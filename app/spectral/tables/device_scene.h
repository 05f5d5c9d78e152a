// SPDX-License-Identifier: Apache-2.0
// The scene as the kernels of engine 1 read it: plain tables, still on the host. Made once a job; tested without a device.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/clusters/clusters.h"
#include "spectral/stretch.h"

#include <vector>

namespace nephroid::spectral {

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
  std::vector<shared::float4> light_xyz;         ///< [light][401]: share times (xbar, ybar, zbar), share
  std::vector<shared::float4> reflected_xyz;     ///< [light][cluster][reflector]; w: the share, as of a white one
  std::vector<shared::float4> reflected_xyz_all; ///< [light][reflector]
  std::vector<float> cluster_cdf;                ///< exact_cdf_from_zero of what paths through glass are worth in each cluster
  std::vector<std::vector<double>> share;        ///< [light][cluster]: of the light's power
  std::vector<std::vector<double>> seen;         ///< [light][cluster]: what the eye makes of that share, (X + Y + Z) / 3: see worth.h
  int attenuator_count = 0, reflector_count = 0;
};

struct DeviceTables {
  shared::DeviceScene scene{};
  shared::DeviceCamera camera{};
  std::vector<shared::DeviceMaterial> materials;
  std::vector<shared::DeviceObject> objects;
  std::vector<shared::DeviceLight> lights;     ///< without those that are left out
  std::vector<scene::Sphere> spheres;          ///< where photons are sent, by all lights together
  std::vector<shared::DeviceTarget> targets;   ///< lists, see DeviceLight::first_target
  std::vector<shared::DeviceEmitter> emitters; ///< photons of one pass, dealt out to lights and clusters
  unsigned photons_per_pass = 0;               ///< as dealt out: at least one for each emitter
  unsigned eye_paths = 1;                      ///< that gather photons, of a pixel in a pass (maps/map_plan.h)
  std::vector<double> importance;              ///< [cluster] 0..1, the largest 1: see Effort
  WavelengthTables wavelengths;
  StretchTables stretch;                 ///< for the same clusters
  double light_towards_targets_w = 0;    ///< power that the emitters send out in a pass, all wavelengths
  std::vector<double> towards_targets_w; ///< [light]: its part of it
  double power_unit = 1;                 ///< W or W m^-2: DeviceLight::radiometric is in these, so that no power leaves single precision
  double caustic_scale = 1, direct_scale = 1; ///< film quanta per unit of XYZ radiance, powers of two
  double direct_limit = 1;                    ///< quanta that one contribution to the direct film may have
  double energy_scale = 1;                    ///< energy quanta per watt, a power of two
};

/// LIGHT_* of kernels/tracing/shared_types.h.
int device_light_type(preset::Light::Type type);

/// Everything but DeviceScene::root, which is the tree's. Throws bad_input at FILE#/pointer where the camera or a light is inside more
/// than MEDIA_DEPTH dielectrics, for a threshold that cluster_wavelengths refuses, and as make_effort does.
DeviceTables make_device_tables(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

} // namespace nephroid::spectral
