// SPDX-License-Identifier: Apache-2.0
// What several half-spaces have in common: a convex body with corners and flat faces.
#pragma once
#include "scene/mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::formats {

/// The points p with dot(normal, p) <= distance.
struct HalfSpace {
  glm::dvec3 normal{0, 1, 0}; ///< a unit vector, out of the body
  double distance = 1;        ///< of its plane from the origin, above 0
};

struct ConvexBody {
  struct Face {
    std::size_t half_space = 0;         ///< whose plane it is in
    std::vector<std::uint32_t> corners; ///< counter-clockwise seen from outside
  };
  std::vector<glm::dvec3> corners;
  std::vector<Face> faces;   ///< none where the body is unbounded
  glm::dvec3 open_towards{}; ///< an axis along which it has no end; 0 where it is bounded

  bool is_bounded() const { return open_towards == glm::dvec3(0); }
  double volume() const; ///< in cubic units of length
};

/// The intersection. Corners that are less than 1e-6 of the largest distance apart become one, and a half-space that
/// cuts off less than that has no face. The faces are closed: each edge has two, of opposite directions. Throws
/// bad_input where roundings leave no such body.
ConvexBody intersection(std::span<const HalfSpace> half_spaces);

/// Each face as a fan of triangles about the corner that makes the smallest of their heights largest.
scene::Mesh mesh_of(const ConvexBody& body);

} // namespace nephroid::formats
