// SPDX-License-Identifier: Apache-2.0
// Neighbouring facets alike, so that the object is easier to make: the thesis' (6.1), Cost_S = alpha_N Cost_N + alpha_P Cost_P. Cost_N of
// a facet is 1 minus the mean of n . n' over its neighbours, four but at the rim, n being unit normals.
#pragma once
#include "inverse/layout.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace nephroid::inverse {

/// The unit normal out of the object.
glm::dvec3 normal_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope);

/// The sum of Cost_N over all facets falls by n . pull where a facet of normal n is put among its neighbours: their normals, times one part
/// in the facet's neighbours and one in each neighbour's own.
glm::dvec3 pull(const Layout& layout, const std::vector<glm::dvec2>& slopes, std::size_t facet);

/// The mean of Cost_N over all facets.
double roughness(const Layout& layout, const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
