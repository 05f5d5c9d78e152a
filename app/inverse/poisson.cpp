// SPDX-License-Identifier: Apache-2.0
#include "inverse/poisson.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace nephroid::inverse {
namespace {

Grid cosines(int nodes)
{
  Grid all(nodes, nodes);
  for (int k = 0; k < nodes; ++k)
    for (int i = 0; i < nodes; ++i) all(k, i) = std::sqrt((k ? 2.0 : 1.0) / nodes) * std::cos(glm::pi<double>() * k * (i + 0.5) / nodes);
  return all;
}

double eigenvalue(int k, int nodes, double spacing) { return 2 * (1 - std::cos(glm::pi<double>() * k / nodes)) / (spacing * spacing); }

} // namespace

Poisson::Poisson(int columns, int rows, const glm::dvec2& spacing)
    : across_(cosines(columns)), down_(cosines(rows)), one_over_value_(Grid::Zero(rows, columns))
{
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      if (x + y > 0) one_over_value_(y, x) = 1 / (eigenvalue(x, columns, spacing.x) + eigenvalue(y, rows, spacing.y));
}

Grid Poisson::solve(const Grid& f) const
{
  const Grid spectrum = (down_ * f * across_.transpose()).cwiseProduct(one_over_value_);
  return down_.transpose() * spectrum * across_;
}

} // namespace nephroid::inverse
