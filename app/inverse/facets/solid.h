// SPDX-License-Identifier: Apache-2.0
// The object as one closed solid in millimetres (thesis section 5.4.2): planar facets about z = 0 and walls between
// them, or a smooth surface, flat sides, and the flat front at z = thickness.
#pragma once
#include "inverse/facets/surface.h"
#include "inverse/layout.h"
#include "scene/mesh.h"

#include <memory>
#include <span>

namespace nephroid::inverse {

enum class Part : std::uint8_t { facet, wall, side, front };

/// The plane z = height + gradient . (p - its middle).
struct Facet {
  glm::dvec2 slope{0}, gradient{0};
  double height = 0;
};

struct Solid {
  scene::Mesh mesh;                       ///< counter-clockwise seen from outside
  std::vector<Part> parts;                ///< a part for each triangle
  std::vector<Facet> facets;              ///< in the layout's order
  double lowest = 0, highest = 0;         ///< z of the facets' corners
  double steepest_deg = 0;                ///< between a facet and the front
  double highest_wall = 0;                ///< between two facets
  double wall_area = 0;                   ///< mm^2, between facets
  std::shared_ptr<const Surface> surface; ///< what a lens' triangles stand for
  double steepest_wall_deg = 90;          ///< between a wall and the front
  double relief() const { return highest - lowest; }
};

/// Every edge has two triangles, which pass it in opposite directions, and every triangle has an area: see Post in
/// solid.cpp. `heights` has z of the facets' middles; without it they are as the layout says.
Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights);
Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
