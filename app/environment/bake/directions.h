// SPDX-License-Identifier: Apache-2.0
// The directions that light is baked from: points of a cube's surface, towards its middle (thesis 3.1). Each face is a square grid whose
// points on edges and corners it shares with its neighbours: 3 x 3 points a face are 26 in all (8 corners, 12 middles of edges, 6 of
// faces), 5 x 5 are 98, 9 x 9 are 386.
#pragma once
#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace nephroid::environment {

/// How many there may be.
std::span<const int> direction_counts();

/// The points of a cube from -m to m, m = 1, 2 or 4, with whole coordinates: of x, y and z the last changes fastest. count: one of
/// direction_counts().
std::vector<glm::ivec3> cube_points(int count);

/// Unit, the way the light goes, of each of cube_points(count).
std::vector<glm::dvec3> light_directions(int count);

} // namespace nephroid::environment
