// SPDX-License-Identifier: Apache-2.0
// The corners of one object's triangles, its ellipsoids, and the box about it.
#pragma once
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <span>

namespace nephroid::scene {

/// A box along the axes. Without a point in it, as it is made here, low is above high.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
};

Bounds enclosing(const Bounds& a, const Bounds& b);
Bounds bounds_of(const Ellipsoid& ellipsoid);

/// Throws failed where the scene does not hold them: a scene of materials and objects alone has no geometry.
std::span<const glm::uvec3> triangles_of(const Scene& scene, const Object& object);

/// Throws as triangles_of.
std::span<const Ellipsoid> ellipsoids_of(const Scene& scene, const Object& object);

/// Calls visit(index of a vertex) for every corner of every triangle. Throws as triangles_of.
template <class Visit>
void for_each_corner_index(const Scene& scene, const Object& object, const Visit& visit)
{
  for (const glm::uvec3& triangle : triangles_of(scene, object))
    for (int corner = 0; corner < 3; ++corner) visit(triangle[corner]);
}

/// Calls visit(glm::dvec3) for every corner of every triangle, and of a box about every ellipsoid along its axes: points whose convex hull
/// holds all of the object. In the scene's coordinates. Throws as triangles_of.
template <class Visit>
void for_each_corner(const Scene& scene, const Object& object, const Visit& visit)
{
  for_each_corner_index(scene, object, [&](std::uint32_t vertex) { visit(glm::dvec3(scene.geometry.positions[vertex])); });
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
    for (unsigned i = 0; i < 8; ++i) {
      glm::dvec3 corner = ellipsoid.centre;
      for (unsigned axis = 0; axis < 3; ++axis) corner += (i >> axis & 1 ? 1.0 : -1.0) * glm::dvec3(ellipsoid.half_axes[axis]);
      visit(corner);
    }
}

/// The smallest along the axes, in the scene's coordinates. Throws as triangles_of.
Bounds bounds_of(const Scene& scene, const Object& object);

} // namespace nephroid::scene
