// SPDX-License-Identifier: Apache-2.0
#include "tracing/lamp_tables.h"

#include "tracing/scales.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace nephroid::tracing {
namespace {

using std::numbers::pi;

glm::dvec3 vector(const shared::float4& v) { return {v.x, v.y, v.z}; }

double degrees(double radians) { return radians * 180 / pi; }

constexpr std::size_t gammas = PHOTOMETRY_GAMMAS, planes = PHOTOMETRY_PLANES;

double gamma_of(std::size_t step) { return pi * static_cast<double>(step) / (gammas - 1); }
double c_of(std::size_t plane) { return 2 * pi * static_cast<double>(plane) / (planes - 1); }

/// The steradians of a direction of the table: what its value adds to the integral of what kernels interpolate, which
/// is linear in gamma and C. With h between two steps the hat about gamma times sin(gamma) is sin(gamma) (2 - 2 cos h)
/// / h, at a pole 1 - sin(h) / h.
double steradians(std::size_t step, std::size_t plane) {
  const double h = gamma_of(1);
  const bool pole = step == 0 || step == gammas - 1, end = plane == 0 || plane == planes - 1;
  return (pole ? 1 - std::sin(h) / h : std::sin(gamma_of(step)) * (2 - 2 * std::cos(h)) / h) * c_of(1) *
         (end ? 0.5 : 1);
}

/// [plane][gamma] over the mean of all directions.
std::vector<float> even_steps(const scene::Photometry& photometry) {
  std::vector<double> values;
  double sum = 0;
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (std::size_t step = 0; step < gammas; ++step) {
      values.push_back(scene::intensity(photometry, degrees(gamma_of(step)), degrees(c_of(plane))));
      sum += values.back() * steradians(step, plane);
    }
  if (!(sum > 0))
    throw bad_input(photometry.file.string(), "shines nowhere in steps of half a degree", "expected a wider beam");
  std::vector<float> table;
  for (const double value : values) table.push_back(static_cast<float>(value * 4 * pi / sum));
  return table;
}

/// In square units. Of an ellipsoid the mean of what kernels draw it by, over a fine grid of the unit sphere.
double area_of(const shared::DevicePrimitive& primitive, bool ellipsoid) {
  const glm::dvec3 x = vector(primitive.edge_u), y = vector(primitive.edge_v), z = vector(primitive.normal);
  if (!ellipsoid) return 0.5 * glm::length(glm::cross(x, y));
  constexpr int across = 512, around = 256;
  double sum = 0;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < around; ++j) {
      const double height = std::cos(pi * (i + 0.5) / across), radius = std::sin(pi * (i + 0.5) / across),
                   phi = 2 * pi * (j + 0.5) / around;
      sum += radius * glm::length(radius * std::cos(phi) * x + radius * std::sin(phi) * y + height * z);
    }
  const double steradians = 4 * std::sin(pi / (2 * across)) * pi / around; // of a cell, over its sine
  return sum * steradians / (glm::length(x) * glm::length(y) * glm::length(z));
}

struct Surfaces {
  std::vector<shared::DevicePrimitive> primitives;
  std::vector<double> areas;
  std::size_t first = 0; ///< in the table of triangles
};

Surfaces surfaces_of(const scene::Scene& scene, const scene::Object& object) {
  const bool ellipsoid = object.triangle_count == 0;
  Surfaces surfaces;
  surfaces.first = ellipsoid ? scene.geometry.triangles.size() + object.first_ellipsoid : object.first_triangle;
  for (std::size_t i = 0; i < (ellipsoid ? object.ellipsoid_count : object.triangle_count); ++i) {
    surfaces.primitives.push_back(device_primitive(scene, surfaces.first + i));
    surfaces.areas.push_back(area_of(surfaces.primitives.back(), ellipsoid));
  }
  return surfaces;
}

/// The rows, then the texels of each row, by luminance.
std::vector<float> picture_table(const scene::LightPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  std::vector<double> rows(height, 0);
  std::vector<float> columns;
  for (std::size_t row = 0; row < height; ++row) {
    const auto begin = picture.luminance.begin() + static_cast<std::ptrdiff_t>(row * width);
    const std::vector<double> texels(begin, begin + static_cast<std::ptrdiff_t>(width));
    for (const double texel : texels) rows[row] += texel;
    const std::vector<float> cdf = exact_cdf(texels);
    columns.insert(columns.end(), cdf.begin(), cdf.end());
  }
  std::vector<float> table = exact_cdf(rows);
  table.insert(table.end(), columns.begin(), columns.end());
  return table;
}

float word(std::size_t value) { return std::bit_cast<float>(static_cast<std::int32_t>(value)); }
std::size_t word(float value) { return static_cast<std::size_t>(std::bit_cast<std::int32_t>(value)); }

/// choose and place_in_bin of kernels/tracing: the bin of a number, and the place in it.
std::pair<std::size_t, double> bin_of(const float* cdf, std::size_t count, float number) {
  const auto bin = static_cast<std::size_t>(std::upper_bound(cdf, cdf + count - 1, number) - cdf);
  const double before = bin > 0 ? cdf[bin - 1] : 0;
  return {bin, (number + 0x1p-25 - before) / (cdf[bin] - before)};
}

} // namespace

std::shared_ptr<const LampTables> make_lamp_tables(const scene::Scene& scene,
                                                   const std::vector<const scene::Light*>& from,
                                                   std::vector<shared::DeviceLight>& lights) {
  LampTables tables;
  tables.surfaces.resize(lights.size());
  std::map<const void*, int> places; // of tables that lights share
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const scene::Light& light = *from[i];
    shared::DeviceLight& out = lights[i];
    const void* const shared = light.photometry.get();
    std::vector<float> table;
    if (shared && places.contains(shared)) {
      out.table = places[shared];
      continue;
    }
    if (light.photometry) table = even_steps(*light.photometry);
    if (light.picture) {
      table = picture_table(*light.picture);
      out.edge_u.w = word(static_cast<std::size_t>(light.picture->width));
      out.edge_v.w = word(static_cast<std::size_t>(light.picture->height));
    }
    if (light.object >= 0) {
      Surfaces surfaces = surfaces_of(scene, scene.objects[static_cast<std::size_t>(light.object)]);
      table = exact_cdf(surfaces.areas);
      out.edge_u.w = word(table.size());
      out.edge_v.w = word(surfaces.first);
      double area = 0;
      for (const double part : surfaces.areas) area += part;
      out.solid_angle = static_cast<float>(area);
      tables.surfaces[i] = std::move(surfaces.primitives);
    }
    if (table.empty()) continue;
    if (tables.lamp_tables.size() + table.size() > std::size_t{1} << 30)
      throw bad_input(Location(scene.source) / "scene" / "lights", "have tables of more than 4 GiB", {},
                      "make their pictures or meshes smaller");
    out.table = static_cast<int>(tables.lamp_tables.size());
    if (shared) places[shared] = out.table;
    tables.lamp_tables.insert(tables.lamp_tables.end(), table.begin(), table.end());
  }
  return tables.lamp_tables.empty() ? nullptr : std::make_shared<const LampTables>(std::move(tables));
}

glm::dvec3 lamp_place(const SceneTables& tables, int light, float x, float y) {
  const shared::DeviceLight& lamp = tables.lights[static_cast<std::size_t>(light)];
  const auto on_rectangle = [&](double u, double v) {
    return vector(lamp.position) + (u - 0.5) * vector(lamp.edge_u) + (v - 0.5) * vector(lamp.edge_v);
  };
  if (lamp.type == LIGHT_AREA && lamp.table < 0) return on_rectangle(x, y);
  if ((lamp.type != LIGHT_AREA && lamp.type != LIGHT_MESH) || lamp.table < 0) return vector(lamp.position);
  const float* const table = tables.lamps->lamp_tables.data() + lamp.table;
  if (lamp.type == LIGHT_AREA) {
    const std::size_t width = word(lamp.edge_u.w), height = word(lamp.edge_v.w);
    const auto [row, down] = bin_of(table, height, y);
    const auto [column, along] = bin_of(table + height + row * width, width, x);
    return on_rectangle((static_cast<double>(column) + along) / static_cast<double>(width),
                        1 - (static_cast<double>(row) + down) / static_cast<double>(height));
  }
  const auto [chosen, rest] = bin_of(table, word(lamp.edge_u.w), x);
  const shared::DevicePrimitive& primitive = tables.lamps->surfaces[static_cast<std::size_t>(light)][chosen];
  const glm::dvec3 corner = vector(primitive.corner), u = vector(primitive.edge_u), v = vector(primitive.edge_v);
  const int kind = std::bit_cast<int>(primitive.corner.w) & 3;
  if (kind == PRIMITIVE_ELLIPSOID || kind == PRIMITIVE_ELLIPSOID_INWARDS) {
    const glm::dvec3 w = vector(primitive.normal);
    const double z = 2 * rest - 1, radius = std::sqrt(std::max(1 - z * z, 0.0)), phi = 2 * pi * y;
    return corner + radius * std::cos(phi) / glm::dot(u, u) * u + radius * std::sin(phi) / glm::dot(v, v) * v +
           z / glm::dot(w, w) * w;
  }
  const double root = std::sqrt(rest);
  return corner + (1 - root) * u + y * root * v;
}

double photometric_share(const scene::Light& light, const std::vector<scene::Sphere>& targets) {
  const std::vector<float> table = even_steps(*light.photometry);
  const double cell = gamma_of(1) + c_of(1); // no direction is farther from one of the table
  double share = 0;
  for (const scene::Sphere& target : targets) {
    const glm::dvec3 way = glm::dvec3(target.centre) - glm::dvec3(light.position);
    const double distance = glm::length(way), radius = target.radius;
    if (distance <= radius) return 1;
    const double half_angle = std::asin(radius / distance), least_cosine = std::cos(std::min(half_angle + cell, pi));
    double sum = 0, brightest = 0;
    for (std::size_t plane = 0; plane < planes; ++plane)
      for (std::size_t step = 0; step < gammas; ++step) {
        const double gamma = gamma_of(step), c = c_of(plane);
        const glm::dvec3 direction =
            std::cos(gamma) * glm::dvec3(light.direction) +
            std::sin(gamma) * (std::cos(c) * glm::dvec3(light.edge_u) + std::sin(c) * glm::dvec3(light.edge_v));
        if (glm::dot(direction, way) < least_cosine * distance) continue;
        const double value = table[plane * gammas + step];
        sum += value * steradians(step, plane) / (4 * pi);
        brightest = std::max(brightest, value);
      }
    share += std::min(sum, brightest * std::pow(std::sin(half_angle / 2), 2)); // (1 - cos) / 2 of the sphere
  }
  return std::min(share, 1.0);
}

} // namespace nephroid::tracing
