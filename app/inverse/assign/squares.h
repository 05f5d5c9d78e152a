// SPDX-License-Identifier: Apache-2.0
// What the search lowers: squares of what is too much or too little in each cell.
#pragma once
#include "inverse/layout.h"

#include <span>
#include <vector>

namespace nephroid::inverse {

/// The weights of the pictures' squares. They are the layout's, scaled so that pictures of one weight count alike: a
/// cost is of light over its maximum, and a mean over the cells with light in them.
std::vector<double> picture_weights(const Layout& layout, const std::vector<Target>& targets);

/// The sum that the search lowers: weight * (Z - T)^2 over receivers and cells, with as much wanted light as there are
/// facets. `light` is [receiver][cell], in units of facets that send all of theirs.
double weighted_squares(const std::vector<Target>& targets, std::span<const double> weights,
                        const std::vector<std::vector<double>>& light, std::size_t facets);

} // namespace nephroid::inverse
