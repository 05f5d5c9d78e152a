// SPDX-License-Identifier: Apache-2.0
// Lamps of some size: places that are points of light, as many for every lamp.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The places of a flat lamp or of a mesh, from the middle of all. w: a place's power over that of one in the middle.
/// Of a mesh they are what the middle of the front sees, equal parts of its outline: it is equally bright everywhere,
/// by the cosine law.
struct Lamp {
  glm::dvec3 middle{0};
  std::vector<glm::dvec4> places;
};

/// Type area: parallel to the front. `middle` is in the layout's millimetres.
Lamp flat_lamp(const Light& light, const glm::dvec3& middle);
/// Type mesh: its origin at `origin`. Throws bad_input at `where` for what load_mesh refuses and for a mesh that
/// reaches the front or is only seen edge on.
Lamp mesh_lamp(const Light& light, const glm::dvec3& origin, double thickness, const Location& where);

/// Along x and y, as the middle of the front sees them at the distance of the lamp's middle.
glm::dmat2 covariance_of_places(const Lamp& lamp, double thickness);

/// The lower triangle L with L L^T = covariance.
glm::dmat2 lower_root(const glm::dmat2& covariance);

} // namespace nephroid::inverse
