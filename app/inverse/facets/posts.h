// SPDX-License-Identifier: Apache-2.0
// The vertical lines where four facets meet, and the vertices on them.
//
// Each of the four facets ends at a height of its own, and a wall stands between each two neighbours. Along the line the walls' ends
// overlap; for every stretch of it to be an edge of two walls, a wall's end has vertices wherever another one begins or ends. One case
// remains. Where two facets across from each other are both higher than the two others, all four walls share the stretch between. There
// they are joined in pairs by edges of their own, told apart by one vertex more: at the lower end around the higher facets, at the upper
// end around the lower ones. So the surface does not touch itself in a vertex either.
#pragma once
#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::inverse {

/// A vertex of the mesh, with its height in double precision.
struct Vertex {
  double z = 0;
  std::uint32_t id = 0;
};

/// Facets around are counted counter-clockwise seen from above (+z): 0 is at +x +y. Wall k stands between facets k and k + 1.
struct Post {
  std::array<Vertex, 4> ends;                 ///< of each facet around; equal heights are one vertex
  std::array<std::vector<Vertex>, 4> between; ///< of each wall, ascending: what its end has strictly between the ends of its facets
};

/// Heights that are closer than `joins` become one, so that no triangle is thinner than single precision can tell. at: x and y.
Post make_post(const glm::dvec2& at, std::array<double, 4> heights, double joins, scene::Mesh& mesh);

/// A wall's end from the bottom to the top, both ends included; one vertex where there is no wall.
std::vector<Vertex> end_of_wall(const Post& post, std::size_t wall);

} // namespace nephroid::inverse
