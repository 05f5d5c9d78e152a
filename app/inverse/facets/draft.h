// SPDX-License-Identifier: Apache-2.0
// The solid with walls that lean, so that it can be milled and leaves a mould.
#pragma once
#include "inverse/facets/solid.h"

namespace nephroid::inverse {

/// Facets keep their planes and give up a strip along each edge, where the wall to the neighbour leans: both sides of
/// an edge give as much, so much that no wall is steeper than the layout's draft lets it be, and at most most_given of
/// a facet's width. Four facets meet in a patch about their common corner. So the facets' side is one height over the
/// front. Every edge has two triangles, which pass it in opposite directions, and every triangle has an area.
Solid make_drafted_solid(const Layout& layout, const std::vector<glm::dvec2>& slopes,
                         const std::vector<double>& heights);

inline constexpr double most_given = 0.4;

} // namespace nephroid::inverse
