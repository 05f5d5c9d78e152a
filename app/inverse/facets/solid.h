// SPDX-License-Identifier: Apache-2.0
// The object as one closed solid in millimetres (thesis section 5.4.2): planar facets with their middles at z = 0, vertical walls between
// them, flat sides, and the flat front at z = thickness.
#pragma once
#include "inverse/layout.h"
#include "scene/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::inverse {

enum class Part : std::uint8_t { facet, wall, side, front };

struct Solid {
  scene::Mesh mesh;        ///< counter-clockwise seen from outside
  std::vector<Part> parts; ///< of each triangle
  double relief = 0;       ///< from the lowest corner of a facet to the highest
  double steepest_deg = 0; ///< between a facet and the front
};

/// Every edge has two triangles, which pass it in opposite directions, and every triangle has an area: see posts.h.
Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes);

/// Wavefront OBJ, and binary STL.
std::string to_obj(const scene::Mesh& mesh);
std::string to_stl(const scene::Mesh& mesh);

} // namespace nephroid::inverse
