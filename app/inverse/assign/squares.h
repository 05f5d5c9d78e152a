// SPDX-License-Identifier: Apache-2.0
// What the search lowers: squares of what is too much or too little in each cell.
#pragma once
#include "inverse/layout.h"

#include <span>
#include <vector>

namespace nephroid::inverse {

/// Of each picture's squares: the layout's weights, so that pictures of one weight count alike. Their cost is of light
/// over its maximum, and a mean over the cells with light in them.
std::vector<double> picture_weights(const Layout& layout, const std::vector<Target>& targets);

/// Sum over receivers and cells of weight * (Z - T)^2, of as much wanted light as there are facets: what is lowered.
/// light: [receiver][cell], in facets that send all of theirs.
double weighted_squares(const std::vector<Target>& targets, std::span<const double> weights,
                        const std::vector<std::vector<double>>& light, std::size_t facets);

} // namespace nephroid::inverse
