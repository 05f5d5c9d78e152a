// SPDX-License-Identifier: Apache-2.0
// The corners of one object's triangles, and the box about them.
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

/// Throws failed where the scene does not hold them: a scene of materials and objects alone has no geometry.
std::span<const glm::uvec3> triangles_of(const Scene& scene, const Object& object);

/// Calls visit(index of a vertex) for every corner of every triangle. Throws as triangles_of.
template <class Visit>
void for_each_corner_index(const Scene& scene, const Object& object, const Visit& visit)
{
  for (const glm::uvec3& triangle : triangles_of(scene, object))
    for (int corner = 0; corner < 3; ++corner) visit(triangle[corner]);
}

/// Calls visit(glm::dvec3) for every corner of every triangle, in the scene's coordinates. Throws as triangles_of.
template <class Visit>
void for_each_corner(const Scene& scene, const Object& object, const Visit& visit)
{
  for_each_corner_index(scene, object, [&](std::uint32_t vertex) { visit(glm::dvec3(scene.geometry.positions[vertex])); });
}

/// Of the corners, in the scene's coordinates. Throws as triangles_of.
Bounds bounds_of(const Scene& scene, const Object& object);

} // namespace nephroid::scene
