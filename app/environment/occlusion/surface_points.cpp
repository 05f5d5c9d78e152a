// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/surface_points.h"

#include "scene/bvh.h"
#include "scene/scene.h"

#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::environment {
namespace {

double part(double x) { return x - std::floor(x); }

using Corners = std::array<glm::dvec3, 3>;

double area(const Corners& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; }

/// Thomsen's approximation, within 1.1 %.
double area(const scene::Ellipsoid& ellipsoid)
{
  constexpr double p = 1.6075;
  const auto& axes = ellipsoid.half_axes;
  const double a = glm::length(axes[0]), b = glm::length(axes[1]), c = glm::length(axes[2]);
  return 4 * std::numbers::pi * std::pow((std::pow(a * b, p) + std::pow(b * c, p) + std::pow(c * a, p)) / 3, 1 / p);
}

/// The i-th of an additive recurrence over the square, whose upper half is folded onto the lower.
glm::dvec3 point(const Corners& t, std::size_t i)
{
  const double u = part(0.5 + 0.7548776662 * static_cast<double>(i)), v = part(0.5 + 0.5698402910 * static_cast<double>(i));
  return u + v > 1 ? t[0] + (1 - u) * (t[1] - t[0]) + (1 - v) * (t[2] - t[0]) : t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

glm::dvec3 point(const scene::Ellipsoid& ellipsoid, std::size_t i, std::size_t count)
{
  const glm::dvec3 unit = scene::even_direction(static_cast<int>(i), static_cast<int>(count));
  glm::dvec3 result = ellipsoid.centre;
  for (int k = 0; k < 3; ++k) result += unit[k] * glm::dvec3(ellipsoid.half_axes[static_cast<std::size_t>(k)]);
  return result;
}

/// Calls triangle(Corners) and ellipsoid(Ellipsoid) for all of the objects.
template <class Triangle, class Ellipsoid>
void for_each_piece(const scene::Scene& scene, const std::vector<std::size_t>& objects, const Triangle& triangle,
                    const Ellipsoid& ellipsoid)
{
  const auto place = [&](std::uint32_t vertex) { return glm::dvec3(scene.geometry.positions[vertex]); };
  for (const std::size_t object : objects) {
    for (const glm::uvec3& t : triangles_of(scene, scene.objects[object])) triangle(Corners{place(t.x), place(t.y), place(t.z)});
    for (const scene::Ellipsoid& e : ellipsoids_of(scene, scene.objects[object])) ellipsoid(e);
  }
}

} // namespace

std::vector<glm::dvec3> surface_points(const scene::Scene& scene, const std::vector<std::size_t>& objects, std::size_t count)
{
  double total = 0, before = 0;
  const auto add = [&](const auto& piece) { total += area(piece); };
  for_each_piece(scene, objects, add, add);

  std::vector<glm::dvec3> points;
  // Each count-th of the area has a point, so small triangles share one.
  const auto points_until = [&](double of_area) {
    before += of_area;
    return static_cast<std::size_t>(std::llround(before / total * static_cast<double>(count)));
  };
  for_each_piece(
      scene, objects,
      [&](const Corners& t) {
        for (const std::size_t end = points_until(area(t)); points.size() < end;) points.push_back(point(t, points.size()));
      },
      [&](const scene::Ellipsoid& e) {
        const std::size_t first = points.size(), end = points_until(area(e));
        for (std::size_t i = first; i < end; ++i) points.push_back(point(e, i - first, end - first));
      });
  return points;
}

} // namespace nephroid::environment
