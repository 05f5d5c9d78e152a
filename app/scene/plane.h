// SPDX-License-Identifier: Apache-2.0
// Flat objects.
#pragma once
#include "scene/scene.h"

#include <optional>

namespace nephroid::scene {

struct Plane {
  glm::dvec3 point{0};
  glm::dvec3 normal{0}; ///< unit, of the triangles' front
  double tolerance = 0; ///< of heights: what rounding the corners to single precision may add
  /// The distance from the plane, in scene units; positive before the front.
  double height(const glm::dvec3& p) const { return glm::dot(p - point, normal); }
};

/// The plane that an object lies in, if it is flat, in the scene's coordinates. Throws as triangles_of.
std::optional<Plane> plane_of(const Scene& scene, const Object& object);

} // namespace nephroid::scene
