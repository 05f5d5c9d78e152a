// SPDX-License-Identifier: Apache-2.0
// The object as one closed solid in millimetres (thesis section 5.4.2): planar facets about z = 0 and walls between
// them, or a smooth surface, flat sides, and the flat front at z = thickness.
#pragma once
#include "inverse/facets/surface.h"
#include "inverse/layout.h"
#include "scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {

enum class Part : std::uint8_t { facet, wall, side, front };

/// The plane z = height + gradient . (p - its middle).
struct Facet {
  glm::dvec2 slope{0}, gradient{0};
  double height = 0;
};

struct Solid {
  scene::Mesh mesh;                                                           ///< counter-clockwise seen from outside
  std::vector<Part> parts;                                                    ///< a part for each triangle
  std::vector<Facet> facets;                                                  ///< in the layout's order
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest; ///< z of the facets' corners
  double steepest_deg = 0;                                                    ///< between a facet and the front
  double highest_wall = 0;                                                    ///< between two facets
  double wall_area = 0;                                                       ///< mm^2, between facets
  std::shared_ptr<const Surface> surface;                                     ///< what a lens' triangles stand for
  double steepest_wall_deg = 90;                                              ///< between a wall and the front
  double relief() const { return highest - lowest; }

  std::uint32_t add(const glm::dvec3& at) {
    mesh.positions.emplace_back(at);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, Part part) {
    mesh.triangles.emplace_back(a, b, c);
    parts.push_back(part);
  }
  /// Takes note of the height of a facet's corner.
  void reach(double z) {
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  /// Takes note of how steep a facet is.
  void lean(const glm::dvec2& gradient) {
    steepest_deg = std::max(steepest_deg, glm::degrees(std::atan(glm::length(gradient))));
  }
};

/// Every edge has two triangles, which pass it in opposite directions, and every triangle has an area: see Post in
/// solid.cpp. `heights` has z of the facets' middles; without it they are as the layout says.
Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights);
Solid make_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes);

/// make_solid() where the layout has a draft: walls lean, so that the solid can be milled and leaves a mould. `solid`
/// has its facets, which keep their planes and give up a strip along each edge. Both sides of an edge give equally
/// much: enough that no wall is steeper than the draft allows, and at most four tenths of a facet's width. Four facets
/// meet in a patch about their common corner. So the facets' side has one height at each point of the front.
Solid with_leaning_walls(const Layout& layout, Solid solid);

} // namespace nephroid::inverse
