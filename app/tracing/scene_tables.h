// SPDX-License-Identifier: Apache-2.0
// The scene as kernels read it (kernels/tracing/world.h): plain tables, still on the host. Made once a job; tested
// without a device.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/wavelength_tables.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::tracing {

/// What a run may do without where its scene does not need it; omissions.h says where. A preset leaves out all of that
/// or nothing. Tests turn one thing back on and show that the picture stays the same.
struct LeaveOut {
  bool all = true;              ///< what the others are where nothing else is said
  bool direct = all;            ///< the layer "direct" where no surface is diffuse
  bool photons = all;           ///< photons where no object bends light or no surface is diffuse
  bool photon_maps = all;       ///< photon maps where the camera sees every diffuse surface directly
  bool stray_photons = all;     ///< photons that start towards anything but glass and mirrors
  bool unreached_targets = all; ///< for each light: glass and mirrors outside a spot's cone or behind an area light
  bool dark_lights = all;       ///< lights without power
  bool unlit_wavelengths = all; ///< wavelengths that no light has
  bool occlusion = all;      ///< the shadow ray from a caustic back to the camera where nothing can stand between them
  bool light_types = all;    ///< kernels without the code of types of light that the scene does not have
  bool mirrors = all;        ///< kernels without mirrors
  bool bending = all;        ///< kernels without Snell and Fresnel where all glass has n = 1
  bool attenuation = all;    ///< kernels without absorption where no glass absorbs and no mirror is coloured
  bool smooth_normals = all; ///< kernels without interpolated normals
};

/// The environment as a light, as kernels/tracing/sky.h reads it.
struct SkyTables {
  shared::DeviceBackground size{};
  SKY_TABLES(TABLE_VECTOR)
  shared::float4 mean_colour{}; ///< of all photons
};

struct SceneTables {
  shared::DeviceScene scene{}; ///< but for its root, which is the tree's
  shared::DeviceCamera camera{};
  OBJECT_TABLES(TABLE_VECTOR)
  TARGET_TABLES(TABLE_VECTOR)
  std::vector<scene::Sphere> spheres;   ///< where photons are sent, by all lights together
  std::shared_ptr<const SkyTables> sky; ///< null where the environment is no light; large, so copies share it
  WavelengthTables wavelengths;
  StretchTables stretch;                 ///< for the same clusters
  std::vector<double> towards_targets_w; ///< [light]: power that it sends towards its targets, all wavelengths
  double light_towards_targets_w = 0;    ///< of all lights together
  double power_unit =
      1; ///< W or W m^-2: DeviceLight::radiometric is in these, so that no power leaves single precision
};

/// As devices have vectors.
inline shared::float4 to_float4(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// where: FILE#/scene/camera. Throws bad_input there where it is inside more than MEDIA_DEPTH dielectrics.
shared::DeviceCamera device_camera(const scene::Camera& camera, const Place& where);

/// LIGHT_* of kernels/tracing/shared_types.h.
int device_light_type(const scene::Light& light);

/// clusters: of the 401 wavelengths, each in exactly one. Throws bad_input at FILE#/pointer where the camera or a light
/// is inside more than MEDIA_DEPTH dielectrics.
SceneTables make_scene_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                              const LeaveOut& leave_out);

/// The triangles, then the ellipsoids.
std::vector<shared::DevicePrimitive> device_primitives(const scene::Scene& scene);

/// What a table takes in bytes.
std::uint64_t bytes_of(const auto& items) { return std::uint64_t{items.size()} * sizeof(items[0]); }

/// Bytes of a scene's surfaces on the host.
std::uint64_t mesh_bytes(const scene::Scene& scene);

/// Where texels are looked up: of what is seen, too.
shared::DeviceBackground picture_size(const scene::Environment& environment);

/// Of an environment that is not black. A texel of less than 2^-24 of its row is drawn more often than its flux asks
/// for; its photons carry less then, so that nothing is too bright.
SkyTables make_sky_tables(const scene::Environment& environment);

} // namespace nephroid::tracing
