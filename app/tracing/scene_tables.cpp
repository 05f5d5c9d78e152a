// SPDX-License-Identifier: Apache-2.0
#include "tracing/scene_tables.h"

#include "base/parallel.h"
#include "lights/lights.h"
#include "scene/meter.h"
#include "tracing/lamp_tables.h"
#include "tracing/omissions.h"
#include "tracing/scales.h"
#include "tracing/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace nephroid::tracing {
namespace {

using std::numbers::pi;

/// where: the camera or light that the dielectrics enclose. Throws bad_input there for more than a path can carry.
shared::Media to_media(const std::vector<int>& inside, const Location& where) {
  if (inside.size() > MEDIA_DEPTH)
    throw bad_input(where, fmt::format("is inside {} dielectric objects", inside.size()),
                    fmt::format("expected at most {} around one point", MEDIA_DEPTH),
                    "move it, or take some of them away");
  shared::Media media{};
  for (const int object : inside) {
    media.earlier = media.earlier << MEDIUM_BITS | media.latest >> (64 - MEDIUM_BITS);
    media.latest = media.latest << MEDIUM_BITS | static_cast<std::uint64_t>(object + 1);
  }
  return media;
}

shared::DeviceLight device_light(const scene::Light& light, double power_unit, const Location& where) {
  shared::DeviceLight out = lights::row_of(light);
  out.radiometric = static_cast<float>(scene::radiometric(light) / power_unit);
  out.inside = to_media(light.inside, where / (light.object < 0 ? "position" : "object"));
  return out;
}

/// XYZ of a light's whole spectrum, of power 1. The environment, which has three rows, is the last light.
glm::dvec3 white_xyz(const WavelengthTables& tables, std::size_t light) {
  glm::dvec3 sum(0);
  for (std::size_t w = 0; w < optics::wavelength_count; ++w) {
    const shared::float4& xyz = tables.light_xyz[light * optics::wavelength_count + w];
    sum += glm::dvec3(xyz.x, xyz.y, xyz.z);
  }
  return sum;
}

/// Appends the spheres to the table of targets, unless an earlier light has the same ones.
void set_targets(shared::DeviceLight& light, const std::vector<scene::Sphere>& spheres, SceneTables& tables) {
  std::vector<shared::DeviceTarget> list;
  for (const scene::Sphere& sphere : spheres) list.push_back({to_float4(sphere.centre, sphere.radius)});
  const auto same = [](const shared::DeviceTarget& a, const shared::DeviceTarget& b) {
    const shared::float4 &p = a.centre_radius, &q = b.centre_radius;
    return p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
  };
  auto list_begin = std::search(tables.targets.begin(), tables.targets.end(), list.begin(), list.end(), same);
  if (list_begin == tables.targets.end()) list_begin = tables.targets.insert(list_begin, list.begin(), list.end());
  light.first_target = static_cast<int>(list_begin - tables.targets.begin());
  light.target_count = static_cast<int>(list.size());
}

std::vector<scene::Sphere> scene_targets(const LeaveOut& leave_out, const scene::Scene& scene) {
  std::vector<scene::Sphere> targets;
  if (leave_out.stray_photons) targets = caustic_targets(scene);
  // Photons that run where nothing needs them have nothing to aim at.
  if (!leave_out.stray_photons || (targets.empty() && !leave_out.photons)) return {everything(scene)};
  return targets;
}

/// Adds the light, its targets, and the power that it sends towards them.
void add_light(const scene::Light& light, std::vector<scene::Sphere> targets, const scene::Scene& scene,
               const LeaveOut& leave_out, SceneTables& tables) {
  const auto number = static_cast<int>(&light - scene.lights.data());
  shared::DeviceLight out =
      device_light(light, tables.power_unit, Location(scene.source) / "scene" / "lights" / number);
  out.number = number;
  if (leave_out.unreached_targets)
    std::erase_if(targets, [&](const scene::Sphere& target) { return !lights::model(light).reaches(light, target); });
  set_targets(out, targets, tables);
  tables.lights.push_back(out);
  tables.towards_targets_w.push_back(lights::model(light).towards_w(light, targets, scene.metres_per_unit));
}

/// A power of two near the power of the strongest light.
double choose_power_unit(const scene::Scene& scene) {
  double strongest = 0;
  for (const scene::Light& light : scene.lights) strongest = std::max(strongest, scene::radiometric(light));
  return power_of_two_below(strongest);
}

/// The least part of the environment's flux that peaks hold: more than rounding.
constexpr double least_peaks = 1e-6;

double chance(const std::vector<float>& cdf, std::size_t i) {
  return double(cdf[i]) - (i > 0 ? double(cdf[i - 1]) : 0.0);
}

/// The flux of rows, and the chances of the texels in each.
struct Flux {
  std::vector<double> rows;               ///< [row] grey above the floor, times steradians
  std::vector<std::vector<float>> texels; ///< [row] exact_cdf
  std::array<double, 3> rgb{};            ///< of all rows, in the texels' colours
};

Flux flux_by_rows(const scene::Environment& environment, double floor) {
  const auto width = static_cast<std::size_t>(environment.width), height = static_cast<std::size_t>(environment.height);
  Flux flux;
  for (std::size_t row = 0; row < height; ++row) {
    std::vector<double> values(width);
    double sum = 0;
    const double steradians = scene::texel_steradians(environment, static_cast<int>(row));
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t texel = row * width + column;
      const double grey = scene::grey(environment, texel);
      sum += values[column] = std::max(grey - floor, 0.0);
      for (std::size_t c = 0; c < 3 && grey > 0; ++c)
        flux.rgb[c] += environment.rgb[3 * texel + c] * values[column] / grey * steradians;
    }
    flux.rows.push_back(sum * steradians);
    flux.texels.push_back(exact_cdf(values));
  }
  return flux;
}

/// Throws bad_input where they have more texels together than a kernel can number.
TextureTables make_texture_tables(const scene::Scene& scene, const std::vector<DeviceMaterial>& materials) {
  constexpr std::size_t most_texels = std::size_t{1} << 30;
  static_assert(WRAP_REPEAT == int(preset::Texture::Wrap::repeat) &&
                WRAP_MIRROR == int(preset::Texture::Wrap::mirror) && WRAP_CLAMP == int(preset::Texture::Wrap::clamp));
  TextureTables tables;
  std::map<const void*, std::uint32_t> first_of; // of each picture's texels
  const auto add = [&](const scatter::Texture& from) {
    const auto place = [&](int axis) {
      return std::array{static_cast<float>(from.linear[0][axis]), static_cast<float>(from.linear[1][axis]),
                        static_cast<float>(from.offset[axis])};
    };
    const auto u = place(0), v = place(1);
    const auto [first, is_new] =
        first_of.try_emplace(from.rgb.get(), static_cast<std::uint32_t>(tables.texture_texels.size() / 3));
    tables.textures.push_back(
        {first->second, from.width, from.height, int(from.wrap), from.nearest, {u[0], u[1], u[2]}, {v[0], v[1], v[2]}});
    if (!is_new) return;
    tables.texture_texels.insert(tables.texture_texels.end(), from.rgb->begin(), from.rgb->end());
    if (tables.texture_texels.size() / 3 > most_texels)
      throw bad_input("scene.materials", fmt::format("have textures of more than {} texels", most_texels), {},
                      "make them smaller");
  };
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].texture >= 0) add(*scene.materials[i].texture);
    if (materials[i].roughness_texture >= 0) add(*scene.materials[i].roughness_texture);
    if (materials[i].normal_map >= 0) add(*scene.materials[i].normal_map);
  }
  for (const scene::Texcoords& corners : scene.geometry.texcoords)
    for (const glm::vec2& corner : corners)
      for (int axis = 0; axis < 2; ++axis) tables.texcoords.push_back(corner[axis]);
  return tables;
}

MeterTables make_meter_tables(const scene::MeterSurface& meter, double metres_per_unit) {
  MeterTables tables;
  for (const scene::MeterChart& chart : meter.charts)
    tables.meter_charts.push_back({to_float4(chart.right, chart.left),
                                   to_float4(chart.up, chart.top),
                                   to_float4(chart.normal(), chart.height),
                                   static_cast<float>(1 / chart.cell_width),
                                   static_cast<float>(1 / chart.cell_height),
                                   chart.columns,
                                   chart.rows,
                                   static_cast<int>(chart.first),
                                   int(meter.is_flat),
                                   {}});
  tables.meter_limits = {to_float4(meter.low), to_float4(meter.high), to_float4(meter.facing, meter.least_cosine)};
  tables.meter_cells = meter.cells;
  tables.meter_pieces.assign(meter.first_piece.begin(), meter.first_piece.end());
  tables.meter_chances = meter.chances;
  for (const double area : meter.areas)
    tables.meter_density.push_back(static_cast<float>(1 / (area * metres_per_unit * metres_per_unit)));
  return tables;
}

/// The object's number and the primitive's kind, as a kernel reads them from a w.
float tag(int object, int kind) { return std::bit_cast<float>(object << 2 | kind); }

shared::float4 with(const glm::vec3& v, float w) { return {v.x, v.y, v.z, w}; }

/// Packs 21 bits a coordinate, in units of 2^-20, into two words: the lowest bits are x, then come y and z.
std::array<float, 2> packed_normal(const glm::vec3& normal) {
  constexpr float unit = 0x1p20f;
  const glm::uvec3 q(glm::ivec3(glm::clamp(glm::round(normal * unit), -unit, unit - 1)) & 0x1fffff);
  return {std::bit_cast<float>(q.x | q.y << 21), std::bit_cast<float>(q.y >> 11 | q.z << 10)};
}

float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

/// A flat one.
shared::DevicePrimitive device_triangle(const std::array<glm::vec3, 3>& corners, int object) {
  const glm::vec3& a = corners[0];
  const glm::vec3 ab = corners[1] - a, ac = corners[2] - a;
  const glm::vec3 normal(glm::normalize(glm::cross(glm::dvec3(ab), glm::dvec3(ac))));
  // The formula of triangle_offset of kernels/tracing/surface.h.
  const float offset = 0x1p-21f * largest(glm::max(glm::abs(a), glm::max(glm::abs(ab), glm::abs(ac))));
  return {with(a, tag(object, PRIMITIVE_FLAT)), with(ab, 0), with(ac, 0), with(normal, offset)};
}

shared::DevicePrimitive device_triangle(const scene::Mesh& mesh, const glm::uvec3& triangle, int object, bool smooth) {
  const glm::vec3 a = mesh.positions[triangle.x], ab = mesh.positions[triangle.y] - a,
                  ac = mesh.positions[triangle.z] - a;
  if (smooth) {
    const auto first = packed_normal(mesh.normals[triangle.x]), second = packed_normal(mesh.normals[triangle.y]),
               third = packed_normal(mesh.normals[triangle.z]);
    return {with(a, tag(object, PRIMITIVE_SMOOTH)),
            with(ab, third[0]),
            with(ac, third[1]),
            {first[0], first[1], second[0], second[1]}};
  }
  return device_triangle({a, mesh.positions[triangle.y], mesh.positions[triangle.z]}, object);
}

shared::DevicePrimitive device_ellipsoid(const scene::Ellipsoid& ellipsoid, int object) {
  const auto rows = scene::to_unit_sphere(ellipsoid);
  const int kind = ellipsoid.inwards ? PRIMITIVE_ELLIPSOID_INWARDS : PRIMITIVE_ELLIPSOID;
  return {with(ellipsoid.centre, tag(object, kind)), to_float4(rows[0]), to_float4(rows[1]), to_float4(rows[2])};
}

} // namespace

shared::DevicePrimitive device_primitive(const scene::Scene& scene, std::size_t i) {
  const scene::Mesh& mesh = scene.geometry;
  const auto object = static_cast<int>(scene.object_of_primitive[i]);
  return i < mesh.triangles.size()
             ? device_triangle(mesh, mesh.triangles[i], object, scene.objects[scene.object_of_primitive[i]].smooth)
             : device_ellipsoid(mesh.ellipsoids[i - mesh.triangles.size()], object);
}

std::vector<shared::DevicePrimitive> device_primitives(const scene::Scene& scene) {
  const std::size_t met = scene.object_of_primitive.size();
  const auto& meter = scene.camera.meter;
  std::vector<shared::DevicePrimitive> primitives(met + (meter ? meter->pieces.size() : 0));
  for_ranges(primitives.size(), 1 << 14, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      primitives[i] = i < met ? device_primitive(scene, i) : device_triangle(meter->pieces[i - met], meter->white);
  });
  return primitives;
}

std::uint64_t mesh_bytes(const scene::Scene& scene) {
  const scene::Mesh& mesh = scene.geometry;
  return bytes_of(mesh.triangles) + bytes_of(mesh.positions) + bytes_of(mesh.normals) +
         bytes_of(scene.object_of_primitive);
}

shared::DeviceBackground picture_size(const scene::Environment& environment) {
  return {environment.width, environment.height, static_cast<float>(std::fmod(environment.rotate_deg, 360.0) / 360), 0};
}

SkyTables make_sky_tables(const scene::Environment& environment) {
  const scene::EnvironmentFlux whole = scene::flux_of(environment);
  const Flux flux = flux_by_rows(environment, 0), peaks = flux_by_rows(environment, whole.grey / (4 * pi));
  const auto width = static_cast<std::size_t>(environment.width);
  SkyTables tables;
  tables.size = picture_size(environment);
  tables.texel_cdf = exact_cdf(flux.rows);
  const auto colour = [&](const Flux& of) {
    return to_float4({of.rgb[0] / whole.grey, of.rgb[1] / whole.grey, of.rgb[2] / whole.grey});
  };
  tables.mean_colour = colour(flux);
  tables.peak_colour = colour(peaks);
  tables.texel_colour.reserve(environment.rgb.size());
  for (std::size_t row = 0; row < flux.rows.size(); ++row) {
    const double steradians = scene::texel_steradians(environment, static_cast<int>(row)),
                 row_chance = chance(tables.texel_cdf, row);
    for (std::size_t column = 0; column < width; ++column) {
      const double drawn = row_chance * chance(flux.texels[row], column);
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = environment.rgb[3 * (row * width + column) + c];
        tables.texel_colour.push_back(drawn > 0 ? static_cast<float>(value * steradians / (whole.grey * drawn)) : 0.0f);
      }
    }
  }
  const auto append = [&](const std::vector<float>& cdf) {
    tables.texel_cdf.insert(tables.texel_cdf.end(), cdf.begin(), cdf.end());
  };
  std::ranges::for_each(flux.texels, append);
  tables.peak_part = std::accumulate(peaks.rows.begin(), peaks.rows.end(), 0.0) / whole.grey;
  tables.size.has_peaks = tables.peak_part > least_peaks;
  if (!tables.size.has_peaks) return tables;
  append(exact_cdf(peaks.rows));
  std::ranges::for_each(peaks.texels, append);
  return tables;
}

shared::DeviceCamera device_camera(const scene::Camera& camera, const Location& where) {
  shared::DeviceCamera out{};
  out.position = to_float4(camera.position);
  out.right = to_float4(camera.right);
  out.up = to_float4(camera.up);
  out.forward = to_float4(camera.forward);
  out.tan_x = static_cast<float>(camera.tan_x);
  out.tan_y = static_cast<float>(camera.tan_y);
  out.width = camera.width;
  out.height = camera.height;
  out.inside = to_media(camera.inside, where / "position");
  out.receiver = camera.receiver;
  out.orthographic = int(camera.orthographic);
  out.shift_x = static_cast<float>(camera.shift.x);
  out.shift_y = static_cast<float>(camera.shift.y);
  if (camera.meter) {
    out.receiver = camera.meter->object;
    out.meter_charts = static_cast<int>(camera.meter->charts.size());
  }
  out.lens_radius = static_cast<float>(camera.lens_radius);
  out.focus = static_cast<float>(camera.focus);
  return out;
}

SceneTables make_scene_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                              const LeaveOut& leave_out) {
  constexpr std::size_t most_objects = (1 << MEDIUM_BITS) - 1; // a path's list of media numbers them from 1
  if (scene.objects.size() > most_objects)
    throw bad_input("scene.objects", fmt::format("has {} objects", scene.objects.size()),
                    fmt::format("at most {}", most_objects), "join some of them to one mesh");
  SceneTables tables;
  tables.power_unit = choose_power_unit(scene);
  std::vector<const scene::Light*> lights;
  for (const scene::Light& light : scene.lights)
    if (has_power(light) || !leave_out.dark_lights) lights.push_back(&light);
  const std::vector<bool> lit =
      leave_out.unlit_wavelengths ? lit_wavelengths(scene) : std::vector<bool>(optics::wavelength_count, true);
  tables.wavelengths = make_wavelength_tables(scene, lights, clusters, lit, tables.materials);
  tables.stretch = make_stretch_tables(scene, clusters, lit);
  for (const scene::Object& object : scene.objects)
    tables.objects.push_back({object.material, object.priority,
                              static_cast<int>(std::int64_t{object.first_triangle} - object.first_texcoords)});
  if (!scene.geometry.texcoords.empty())
    tables.textures = std::make_shared<const TextureTables>(make_texture_tables(scene, tables.materials));
  tables.spheres = scene_targets(leave_out, scene);
  for (const scene::Light* light : lights) {
    add_light(*light, tables.spheres, scene, leave_out, tables);
    if (!is_environment(*light)) continue;
    tables.sky = std::make_shared<const SkyTables>(make_sky_tables(*scene.environment));
    tables.lights.back().as.environment.mean_colour = tables.sky->mean_colour;
  }
  for (std::size_t l = 0; l < lights.size(); ++l)
    if (tables.lights[l].type == LIGHT_MESH) tables.lights[l].as.mesh.xyz = to_float4(white_xyz(tables.wavelengths, l));
  tables.lamps = make_lamp_tables(scene, lights, tables.lights);
  if (scene.camera.meter)
    tables.meter = std::make_shared<const MeterTables>(make_meter_tables(*scene.camera.meter, scene.metres_per_unit));
  tables.light_towards_targets_w =
      std::accumulate(tables.towards_targets_w.begin(), tables.towards_targets_w.end(), 0.0);
  tables.camera = device_camera(scene.camera, Location(scene.source) / "scene" / "camera");
  tables.camera.first_piece = static_cast<int>(scene.object_of_primitive.size());

  tables.scene.material_count = static_cast<int>(scene.materials.size());
  tables.scene.light_count = static_cast<int>(tables.lights.size());
  tables.scene.cluster_count = static_cast<int>(tables.wavelengths.clusters.size());
  tables.scene.metres_per_unit = static_cast<float>(scene.metres_per_unit);
  // This is far enough from any place on the disc of any target, also of the one about everything.
  tables.scene.outside_distance =
      2.5f * std::max(scene_bounds(scene).radius, leave_out.stray_photons ? 0.0f : everything(scene).radius);
  tables.scene.max_surfaces = 256; // enough for a diamond; at 32 it keeps 2 % of its light to itself
  tables.scene.reflector_count = tables.wavelengths.reflector_count;
  if (tables.sky) tables.scene.sky_size = tables.sky->size;
  return tables;
}

} // namespace nephroid::tracing
