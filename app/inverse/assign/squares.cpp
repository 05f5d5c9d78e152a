// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/squares.h"

#include <algorithm>

namespace nephroid::inverse {

std::vector<double> picture_weights(const Layout& layout, const std::vector<Target>& targets) {
  std::vector<double> weights;
  for (std::size_t j = 0; j < targets.size(); ++j) {
    const double most =
        *std::max_element(targets[j].begin(), targets[j].end()) * static_cast<double>(layout.facet_count());
    weights.push_back((layout.weights ? (*layout.weights)[j] : 1) / (most * most));
  }
  return weights;
}

double weighted_squares(const std::vector<Target>& targets, std::span<const double> weights,
                        const std::vector<std::vector<double>>& light, std::size_t facets) {
  double sum = 0;
  for (std::size_t j = 0; j < light.size(); ++j)
    for (std::size_t c = 0; c < light[j].size(); ++c) {
      const double over = light[j][c] - static_cast<double>(facets) * targets[j][c];
      sum += weights[j] * over * over;
    }
  return sum;
}

} // namespace nephroid::inverse
