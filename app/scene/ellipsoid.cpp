// SPDX-License-Identifier: Apache-2.0
#include "scene/ellipsoid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

std::array<double, 3> lengths(const Ellipsoid& ellipsoid)
{
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = glm::length(glm::dvec3(ellipsoid.half_axes[i]));
  return result;
}

glm::dvec3 on_unit_sphere(const Ellipsoid& ellipsoid, const glm::dvec3& point)
{
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 way = point - glm::dvec3(ellipsoid.centre);
  return {glm::dot(rows[0], way), glm::dot(rows[1], way), glm::dot(rows[2], way)};
}

} // namespace

std::array<glm::dvec3, 3> to_unit_sphere(const Ellipsoid& ellipsoid)
{
  std::array<glm::dvec3, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 axis = ellipsoid.half_axes[i];
    rows[i] = axis / glm::dot(axis, axis);
  }
  return rows;
}

bool contains(const Ellipsoid& ellipsoid, const glm::dvec3& point) { return glm::length(on_unit_sphere(ellipsoid, point)) < 1; }

glm::dvec3 half_extent(const Ellipsoid& ellipsoid)
{
  // The support function: the largest coordinate of sum of u_i a_i over unit vectors u is the length of the a_i's coordinates.
  glm::dvec3 squares(0);
  for (const glm::dvec3 axis : ellipsoid.half_axes) squares += axis * axis;
  return glm::sqrt(squares);
}

double longest_half_axis(const Ellipsoid& ellipsoid) { return std::ranges::max(lengths(ellipsoid)); }
double shortest_half_axis(const Ellipsoid& ellipsoid) { return std::ranges::min(lengths(ellipsoid)); }

double volume_of(const Ellipsoid& ellipsoid)
{
  const auto [a, b, c] = lengths(ellipsoid);
  return 4 * std::numbers::pi / 3 * a * b * c;
}

// The gradient of |M (p - c)|^2 is 2 M^T M (p - c).
glm::dvec3 normal_at(const Ellipsoid& ellipsoid, const glm::dvec3& point)
{
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 unit = on_unit_sphere(ellipsoid, point);
  const glm::dvec3 outwards = glm::normalize(unit.x * rows[0] + unit.y * rows[1] + unit.z * rows[2]);
  return ellipsoid.inwards ? -outwards : outwards;
}

} // namespace nephroid::scene
