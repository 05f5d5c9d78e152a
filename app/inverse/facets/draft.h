// SPDX-License-Identifier: Apache-2.0
// The solid with walls that lean, so that it can be milled and leaves a mould.
#pragma once
#include "inverse/facets/solid.h"

namespace nephroid::inverse {

/// Facets keep their planes and give up a strip along each edge, where the wall to the neighbour leans. Both sides of
/// an edge give equally much: enough that no wall is steeper than the layout's draft allows, and at most most_given of
/// a facet's width. Four facets meet in a patch about their common corner. So the facets' side has one height at each
/// point of the front. Every edge has two triangles, which pass it in opposite directions, and every triangle has an
/// area.
Solid make_drafted_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes,
                         const std::vector<double>& heights);

inline constexpr double most_given = 0.4;

} // namespace nephroid::inverse
