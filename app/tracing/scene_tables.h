// SPDX-License-Identifier: Apache-2.0
// The scene as kernels read it (kernels/tracing/world.h): plain tables on the host, made once a job.
#pragma once
#include "lights/lights.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "tracing/wavelength_tables.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::tracing {

/// What a run may leave out where its scene does not need it; omissions.h says where. A preset leaves out all of it or
/// nothing. Tests turn one thing back on and show that the picture stays the same.
struct LeaveOut {
  bool all = true;               ///< the default of the others
  bool direct = all;             ///< the layer "direct" where no surface is diffuse
  bool photons = all;            ///< photons where no object bends light or no surface is diffuse
  bool light_on_receivers = all; ///< light on receivers where the camera sees every diffuse surface directly
  bool stray_photons = all;      ///< photons that start towards anything but glass and mirrors
  bool unreached_targets = all;  ///< for each light: glass and mirrors outside a spot's cone or behind an area light
  bool dark_lights = all;        ///< lights without power
  bool unlit_wavelengths = all;  ///< wavelengths that no light has
  bool occlusion = all;      ///< the shadow ray from a caustic back to the camera where nothing can stand between them
  bool light_types = all;    ///< kernels without the code of types of light that the scene does not have
  bool mirrors = all;        ///< kernels without mirrors
  bool bending = all;        ///< kernels without Snell and Fresnel where all glass has n = 1
  bool attenuation = all;    ///< kernels without absorption where no glass absorbs and no mirror is coloured
  bool smooth_normals = all; ///< kernels without interpolated normals
};

/// The environment as a light, as kernels/lights/sky.h reads it.
struct SkyTables {
  shared::DeviceBackground size{};
  SKY_TABLES(TABLE_VECTOR)
  shared::float4 mean_colour{}; ///< the mean over all photons
  double peak_part = 0;         ///< of the light, what is above the mean over all directions (kernels/lights/sky.h)
  shared::float4 peak_colour{}; ///< mean_colour of that part, less by as much
};

/// Pictures on surfaces, as kernels/scatter/texture.h reads them.
struct TextureTables {
  TEXTURE_TABLES(TABLE_VECTOR)
};

/// What lamps have beyond their DeviceLight, as kernels/lights reads it.
struct LampTables {
  LAMP_TABLES(TABLE_VECTOR)
  std::vector<lights::Surfaces> surfaces; ///< [light] a mesh's, in the order of its table; else nothing
};

/// A meter in the camera's place, as kernels/tracing/meter.h reads it.
struct MeterTables {
  METER_TABLES(TABLE_VECTOR)
};

struct SceneTables {
  shared::DeviceScene scene{}; ///< complete but for `root`, which is the tree's
  shared::DeviceCamera camera{};
  OBJECT_TABLES(TABLE_VECTOR)
  TARGET_TABLES(TABLE_VECTOR)
  std::vector<scene::Sphere> spheres;            ///< the targets of all lights together
  std::shared_ptr<const SkyTables> sky;          ///< null where the environment is no light; large, so copies share it
  std::shared_ptr<const TextureTables> textures; ///< null where there are none; large, so copies share it
  std::shared_ptr<const LampTables> lamps;       ///< null where no lamp has a table; large, so copies share it
  std::shared_ptr<const MeterTables> meter;      ///< null where there is an eye; large, so copies share it
  WavelengthTables wavelengths;
  StretchTables stretch;                 ///< for the clusters of `wavelengths`
  std::vector<double> towards_targets_w; ///< [light]: power that it sends towards its targets, all wavelengths
  double light_towards_targets_w = 0;    ///< the sum over all lights
  double power_unit = 1; ///< the unit of DeviceLight::radiometric in W or W m^-2: every power fits single precision
};

using scene::to_float4;

/// where: FILE#/scene/camera. Throws bad_input there for a camera inside more than MEDIA_DEPTH dielectrics.
shared::DeviceCamera device_camera(const scene::Camera& camera, const Location& where);

/// clusters: each of the 401 wavelengths is in exactly one. Throws bad_input at FILE#/pointer where the camera or a
/// light is inside more than MEDIA_DEPTH dielectrics.
SceneTables make_scene_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                              const LeaveOut& leave_out);

/// number: of the triangles, then the ellipsoids.
shared::DevicePrimitive device_primitive(const scene::Scene& scene, std::size_t number);

/// The triangles, then the ellipsoids, then the pieces of a meter.
std::vector<shared::DevicePrimitive> device_primitives(const scene::Scene& scene);

std::uint64_t bytes_of(const auto& items) { return std::uint64_t{items.size()} * sizeof(items[0]); }

std::uint64_t mesh_bytes(const scene::Scene& scene);

/// Where texels are looked up, for the light and for the background.
shared::DeviceBackground picture_size(const scene::Environment& environment);

/// environment: not black. A texel of less than 2^-24 of its row is drawn more often, and its photons carry less.
SkyTables make_sky_tables(const scene::Environment& environment);

} // namespace nephroid::tracing
