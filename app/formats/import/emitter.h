// SPDX-License-Identifier: Apache-2.0
// A mesh that shines, as what a lamp in its place needs.
#pragma once
#include "scene/mesh.h"

#include <glm/glm.hpp>

#include <array>

namespace nephroid::formats {

/// Places and lengths in the coordinates that the mesh's triangles are brought to.
struct Emitter {
  glm::dvec3 centre{0}; ///< of the area
  glm::dvec3 normal{0}; ///< of a flat one: a unit vector
  glm::dvec3 edge{0};   ///< a unit vector along one of the two edges that are nearest to a right angle
  double area = 0;
  std::array<double, 2> size{}; ///< of a flat one: edges of a rectangle of its area, the first along `edge`
  bool flat = false, rectangle = false;
};

Emitter emitter_of(const scene::Mesh& mesh, const glm::dmat4& to_world);

} // namespace nephroid::formats
