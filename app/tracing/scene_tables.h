// SPDX-License-Identifier: Apache-2.0
// The scene as kernels read it (kernels/tracing/world.h): plain tables, still on the host. Made once a job; tested without a device.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/leave_out.h"
#include "tracing/sky_tables.h"
#include "tracing/stretch.h"
#include "tracing/wavelength_tables.h"

#include <memory>
#include <vector>

namespace nephroid::tracing {

struct SceneTables {
  shared::DeviceScene scene{}; ///< but for its root, which is the tree's
  shared::DeviceCamera camera{};
  std::vector<shared::DeviceMaterial> materials;
  std::vector<shared::DeviceObject> objects;
  std::vector<shared::DeviceLight> lights;   ///< without those that are left out
  std::vector<scene::Sphere> spheres;        ///< where photons are sent, by all lights together
  std::vector<shared::DeviceTarget> targets; ///< lists, see DeviceLight::first_target
  std::shared_ptr<const SkyTables> sky;      ///< null where the environment is no light; large, so copies share it
  WavelengthTables wavelengths;
  StretchTables stretch;                 ///< for the same clusters
  std::vector<double> towards_targets_w; ///< [light]: power that it sends towards its targets, all wavelengths
  double light_towards_targets_w = 0;    ///< of all lights together
  double power_unit = 1;                 ///< W or W m^-2: DeviceLight::radiometric is in these, so that no power leaves single precision
};

/// where: FILE#/scene/camera. Throws bad_input there where it is inside more than MEDIA_DEPTH dielectrics.
shared::DeviceCamera device_camera(const scene::Camera& camera, const Place& where);

/// LIGHT_* of kernels/tracing/shared_types.h.
int device_light_type(preset::Light::Type type);
int device_light_type(const scene::Light& light);

/// clusters: of the 401 wavelengths, each in exactly one. Throws bad_input at FILE#/pointer where the camera or a light is inside more than
/// MEDIA_DEPTH dielectrics.
SceneTables make_scene_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters, const LeaveOut& leave_out);

} // namespace nephroid::tracing
