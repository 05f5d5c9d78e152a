// SPDX-License-Identifier: Apache-2.0
// Lamps of some size: places that are points of light, as many for every lamp.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The 4096 places of a lamp, in millimetres from its middle. w: a place's power over that of one in the middle. Those
/// of a mesh are equal parts of what the middle of the front sees of it; it is equally bright everywhere, by the cosine
/// law.
struct Lamp {
  glm::dvec3 middle{0}; ///< in the layout's millimetres, as all that follows
  std::vector<glm::dvec4> places;
  bool is_disc = false; ///< whether they fill a disc, or an ellipse along x and y
};

/// Type area: parallel to the front.
Lamp flat_lamp(const Light& light, const glm::dvec3& middle);
/// Type mesh: its origin at `origin`; light.file is a path. Throws as load_mesh, and bad_input at `where` for a mesh
/// that reaches the front and for one of which the object sees only an edge.
Lamp mesh_lamp(const Light& light, const glm::dvec3& origin, double thickness, const Location& where);

/// The middles of equal parts of the places, each place scaled from the front's middle to the distance of the lamp's
/// middle. count: LightPoints::most or few, or 1, of which the whole covariance is left. Those of a disc are on a
/// circle: where its radius is 0.5 to 1.2 cells, 8 put 0.002 to 0.02 of the light elsewhere, one box 0.01 to 0.1.
LightPoints points_of_places(const Lamp& lamp, double thickness, std::size_t count);

/// LightPoints::most or few of the light: a lamp's own where it has a size, else a disc's.
const LightPoints& points_of(const Illumination& light, bool few);

/// What a facet that gets the light at the lamp's middle with these sines sees of a place.
glm::dmat3x2 seen_along(const glm::dvec2& sines);

/// lower_root of the covariance along x and y of the light's lamp, as a facet sees it that gets the light at its middle
/// with these sines.
glm::dmat2 root_of_places(const Illumination& light, const glm::dvec2& sines);

/// The lower triangle L with L L^T = covariance.
glm::dmat2 lower_root(const glm::dmat2& covariance);

} // namespace nephroid::inverse
