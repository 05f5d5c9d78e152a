// SPDX-License-Identifier: Apache-2.0
// A mesh that shines, as what a lamp in its place needs.
#pragma once
#include "scene/mesh.h"

#include <glm/glm.hpp>

namespace nephroid::formats {

/// Places and lengths in the coordinates that the mesh's triangles are brought to.
struct Emitter {
  glm::dvec3 centre{0}; ///< of the area
  glm::dvec3 normal{0}; ///< of a flat one: a unit vector; else the sum of its areas as vectors
  double area = 0;
  bool flat = false;
};

Emitter emitter_of(const scene::Mesh& mesh, const glm::dmat4& to_world);

/// Of what the unit sphere becomes. A place u of it has the area |cofactor u| a steradian.
double ellipsoid_area(const glm::dmat3& to_world);

} // namespace nephroid::formats
