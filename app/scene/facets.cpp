// SPDX-License-Identifier: Apache-2.0
#include "scene/facets.h"

#include <glm/gtc/matrix_access.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace nephroid::scene {
namespace {

std::size_t side_of(const glm::dvec3& n) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(n[static_cast<int>(i)]) > std::abs(n[static_cast<int>(axis)])) axis = i;
  return 2 * axis + (n[static_cast<int>(axis)] < 0 ? 1 : 0);
}

/// Facets of an ellipsoid that are nowhere behind its surface.
void add_ellipsoid(const Ellipsoid& e, std::vector<Facet>& facets) {
  constexpr int rings = 128, around = 256;
  const auto on_sphere = [](int ring, int step) {
    const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * step / around;
    return glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
  };
  double inscribed = 0; // the area of the facets with their corners on the unit sphere
  std::vector<std::array<glm::dvec3, 3>> unit;
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < around; ++step) {
      const glm::dvec3 a = on_sphere(ring, step), b = on_sphere(ring + 1, step), c = on_sphere(ring + 1, step + 1),
                       d = on_sphere(ring, step + 1);
      for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
        const double area = 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
        if (area <= 0) continue;
        inscribed += area;
        unit.push_back(t);
      }
    }
  const double half = std::hypot(std::numbers::pi / rings, 2 * std::numbers::pi / around) / 2,
               out = e.inwards ? 1 : 1 / std::cos(half);
  const glm::dmat3 axes(glm::dvec3(e.half_axes[0]), glm::dvec3(e.half_axes[1]), glm::dvec3(e.half_axes[2]));
  const bool turns = (glm::determinant(axes) < 0) != e.inwards;
  // The surface's normal is along gradient (p - centre), so that what it faces most ends in planes through the centre.
  glm::dmat3 gradient(0);
  for (int axis = 0; axis < 3; ++axis)
    gradient += glm::outerProduct(axes[axis], axes[axis]) / std::pow(glm::dot(axes[axis], axes[axis]), 2);
  if (e.inwards) gradient *= -1.0;
  const glm::dvec3 centre(e.centre);
  for (const auto& t : unit) {
    Polygon facet;
    for (const glm::dvec3& corner : t) facet.push_back(centre + axes * (out * corner));
    if (turns) std::swap(facet[1], facet[2]);
    for (std::size_t side = 0; side < 6; ++side) {
      Polygon part = facet;
      const int axis = static_cast<int>(side / 2);
      const glm::dvec3 most = (side % 2 == 0 ? 1.0 : -1.0) * glm::row(gradient, axis);
      for (int other = 0; other < 3; ++other)
        for (const double sign : {1.0, -1.0}) {
          if (other == axis || part.size() < 3) continue;
          const glm::dvec3 way = most + sign * glm::row(gradient, other);
          part = clipped(part, way, glm::dot(centre, way));
        }
      if (part.size() >= 3) facets.push_back({std::move(part), side, 4 * std::numbers::pi / (inscribed * out * out)});
    }
  }
}

} // namespace

glm::dvec3 across(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

Polygon clipped(const Polygon& polygon, const glm::dvec3& way, double least) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = glm::dot(a, way) - least, at_b = glm::dot(b, way) - least;
    if (at_a >= 0) result.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) result.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return result;
}

std::vector<Facet> facets_of(const Scene& scene, const Object& object) {
  std::vector<Facet> facets;
  for (const glm::uvec3& triangle : triangles_of(scene, object)) {
    const auto corner = [&](int i) { return glm::dvec3(scene.geometry.positions[triangle[i]]); };
    Polygon polygon{corner(0), corner(1), corner(2)};
    const std::size_t side = side_of(across(polygon));
    facets.push_back({std::move(polygon), side});
  }
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object)) add_ellipsoid(ellipsoid, facets);
  return facets;
}

} // namespace nephroid::scene
