// SPDX-License-Identifier: Apache-2.0
// Latitude-longitude maps made by formula, and what their light is by sums over texels.
#pragma once
#include "scene/environment.h"
#include "tests/support/test.h"

#include <glm/glm.hpp>

namespace nephroid::test {

inline constexpr double pi = std::numbers::pi;

/// Of a direction that is elevation and azimuth in degrees, the latter from -z towards +x.
inline glm::dvec3 direction_of(double elevation_deg, double azimuth_deg) {
  const double e = elevation_deg * pi / 180, a = azimuth_deg * pi / 180;
  return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

/// The direction of a texel's middle, where the column and row need not be whole: (0, 0) is the picture's upper left
/// corner.
inline glm::dvec3 map_direction(double column, double row, int width, int height) {
  return direction_of(90 - 180 * row / height, 360 * column / width - 180);
}

/// of(direction): linear sRGB.
template <class Of>
scene::Environment made_map(int width, int height, const Of& of) {
  scene::Environment map{width, height, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 rgb = of(map_direction(column + 0.5, row + 0.5, width, height));
      for (int c = 0; c < 3; ++c) map.rgb.push_back(static_cast<float>(rgb[c]));
    }
  return map;
}

inline scene::Environment uniform_map(int width, int height, glm::dvec3 rgb = glm::dvec3(1)) {
  return made_map(width, height, [=](const glm::dvec3&) { return rgb; });
}

/// Radiance times solid angle of every texel: 2 pi / width times the difference of its borders' heights on the sphere.
inline glm::dvec3 flux_of_texels(const scene::Environment& map) {
  long double sums[3] = {0, 0, 0};
  const long double round = 3.14159265358979323846264338327950288L;
  for (int row = 0; row < map.height; ++row) {
    const long double solid_angle =
        2 * round / map.width * (std::cos(round * row / map.height) - std::cos(round * (row + 1) / map.height));
    for (int column = 0; column < map.width; ++column)
      for (int c = 0; c < 3; ++c)
        sums[c] += solid_angle * map.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                              static_cast<std::size_t>(column)) +
                                         static_cast<std::size_t>(c)];
  }
  return map.radiance *
         glm::dvec3(static_cast<double>(sums[0]), static_cast<double>(sums[1]), static_cast<double>(sums[2]));
}

/// A disc of even light.
struct Lamp {
  double elevation_deg, azimuth_deg, radius_deg;
  glm::dvec3 rgb;
};

/// What lies in a direction beside a sky of two colours: the first lamp that it meets.
inline glm::dvec3 sky_with_lamps(const glm::dvec3& direction, const glm::dvec3& top, const glm::dvec3& bottom,
                                 const std::vector<Lamp>& lamps) {
  for (const Lamp& lamp : lamps)
    if (glm::dot(direction, direction_of(lamp.elevation_deg, lamp.azimuth_deg)) > std::cos(lamp.radius_deg * pi / 180))
      return lamp.rgb;
  const double up = (direction.y + 1) / 2;
  return up * up * top + (1 - up * up) * bottom;
}

struct NamedMap {
  std::string name;
  scene::Environment map;
};

/// Six kinds of surroundings as photographers have them.
inline std::vector<NamedMap> synthetic_maps(int width = 256) {
  const auto make = [&](const std::string& name, glm::dvec3 top, glm::dvec3 bottom, const std::vector<Lamp>& lamps) {
    return NamedMap{
        name, made_map(width, width / 2, [&](const glm::dvec3& d) { return sky_with_lamps(d, top, bottom, lamps); })};
  };
  std::vector<Lamp> street;
  for (int i = 0; i < 12; ++i)
    street.push_back({5.0 + 7 * (i % 4), 31.0 * i - 170, 1.5, glm::dvec3(300 + 40 * i, 220, 90 + 10 * (i % 5))});
  return {
      make("noon", {0.4, 0.7, 1.5}, {0.2, 0.15, 0.1}, {{63, 40, 1.5, {9000, 8500, 8000}}}),
      make("sunrise", {0.1, 0.2, 0.5}, {0.5, 0.25, 0.1}, {{4, -75, 1.5, {6000, 2500, 700}}, {4, -75, 12, {4, 2, 0.8}}}),
      make("overcast", {1.2, 1.25, 1.3}, {0.3, 0.3, 0.25}, {}),
      make("studio", {0.03, 0.03, 0.03}, {0.02, 0.02, 0.02},
           {{35, 50, 18, {12, 12, 12}}, {20, -60, 14, {7, 7.5, 9}}, {80, 170, 10, {20, 18, 15}}}),
      make("night", {0.002, 0.003, 0.01}, {0.01, 0.008, 0.005}, street),
      make("room", {0.5, 0.45, 0.4}, {0.2, 0.15, 0.1},
           {{10, -20, 16, {25, 28, 32}}, {15, 120, 10, {18, 20, 22}}, {75, 10, 4, {90, 70, 45}}})};
}

} // namespace nephroid::test
