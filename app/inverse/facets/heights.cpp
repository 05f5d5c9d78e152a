// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/heights.h"

#include "inverse/bending.h"
#include "inverse/poisson.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

using FacetGrid = Eigen::MatrixXd; // (column, row): columns of facets vary fastest in memory, as in the layout

/// The facets' planes and how their edges weigh.
struct Steps {
  Eigen::Index across, down;
  glm::dvec2 facet;
  FacetGrid rise_x, rise_y; ///< how much higher the neighbour at +x, or below, is where the edges' middles meet
  FacetGrid reach;          ///< from a facet's middle to its highest corner
};

Steps steps_of(const Layout& layout, std::span<const glm::dvec2> gradients) {
  Steps s{layout.facets.x, layout.facets.y, layout.facet(), {}, {}, {}};
  s.rise_x = s.rise_y = s.reach = FacetGrid::Zero(s.across, s.down);
  const auto g = [&](Eigen::Index x, Eigen::Index y) { return gradients[static_cast<std::size_t>(y * s.across + x)]; };
  for (Eigen::Index y = 0; y < s.down; ++y)
    for (Eigen::Index x = 0; x < s.across; ++x) {
      if (x + 1 < s.across) s.rise_x(x, y) = (g(x, y).x + g(x + 1, y).x) * s.facet.x / 2;
      if (y + 1 < s.down) s.rise_y(x, y) = -(g(x, y).y + g(x, y + 1).y) * s.facet.y / 2;
      s.reach(x, y) = (std::abs(g(x, y).x) * s.facet.x + std::abs(g(x, y).y) * s.facet.y) / 2;
    }
  return s;
}

/// Heights without bounds. An edge weighs as much as it is long.
FacetGrid free_heights(const Steps& s) {
  FacetGrid right = FacetGrid::Zero(s.across, s.down);
  for (Eigen::Index y = 0; y < s.down; ++y)
    for (Eigen::Index x = 0; x < s.across; ++x) {
      const double to_right = s.facet.y * s.rise_x(x, y), to_below = s.facet.x * s.rise_y(x, y);
      right(x, y) -= to_right + to_below;
      if (x + 1 < s.across) right(x + 1, y) += to_right;
      if (y + 1 < s.down) right(x, y + 1) += to_below;
    }
  const Poisson poisson(static_cast<int>(s.across), static_cast<int>(s.down),
                        1.0 / glm::sqrt(glm::dvec2(s.facet.y, s.facet.x)));
  FacetGrid heights = poisson.solve(right.transpose()).transpose();
  heights.array() -= ((heights + s.reach).maxCoeff() + (heights - s.reach).minCoeff()) / 2;
  return heights;
}

/// Where a facet would stand among its neighbours as they are.
double between_neighbours(const Steps& s, const FacetGrid& h, Eigen::Index x, Eigen::Index y) {
  double sum = 0, weight = 0;
  const auto add = [&](double height, double length) {
    sum += length * height;
    weight += length;
  };
  if (x > 0) add(h(x - 1, y) + s.rise_x(x - 1, y), s.facet.y);
  if (x + 1 < s.across) add(h(x + 1, y) - s.rise_x(x, y), s.facet.y);
  if (y > 0) add(h(x, y - 1) + s.rise_y(x, y - 1), s.facet.x);
  if (y + 1 < s.down) add(h(x, y + 1) - s.rise_y(x, y), s.facet.x);
  return weight > 0 ? sum / weight : 0;
}

void relax(const Steps& s, double band, FacetGrid& h) {
  constexpr int most_rounds = 1000;
  constexpr double still = 1e-4; // in parts of a facet's side
  const double over = 2 / (1 + glm::pi<double>() / static_cast<double>(std::max({s.across, s.down, Eigen::Index{4}})));
  for (int round = 0; round < most_rounds; ++round) {
    double most = 0;
    for (Eigen::Index y = 0; y < s.down; ++y)
      for (Eigen::Index x = 0; x < s.across; ++x) {
        const double before = h(x, y), bound = std::max(0.0, band - s.reach(x, y));
        h(x, y) = std::clamp(before + over * (between_neighbours(s, h, x, y) - before), -bound, bound);
        most = std::max(most, std::abs(h(x, y) - before));
      }
    if (most < still * std::min(s.facet.x, s.facet.y)) return;
  }
}

} // namespace

std::vector<double> least_steps(const Layout& layout, std::span<const glm::dvec2> gradients) {
  const Steps steps = steps_of(layout, gradients);
  FacetGrid heights = free_heights(steps);
  if ((heights + steps.reach).maxCoeff() > layout.band) {
    const FacetGrid bound = (layout.band - steps.reach.array()).max(0.0);
    heights = heights.cwiseMin(bound).cwiseMax(-bound);
    relax(steps, layout.band, heights);
  }
  return {heights.data(), heights.data() + heights.size()};
}

std::vector<double> heights_of(const Layout& layout, std::span<const glm::dvec2> slopes) {
  if (!layout.free_heights) return std::vector<double>(slopes.size());
  std::vector<glm::dvec2> gradients;
  for (std::size_t i = 0; i < slopes.size(); ++i)
    gradients.push_back(facet_gradient(slopes[i], layout.n, layout.sines_on(i)));
  return least_steps(layout, gradients);
}

} // namespace nephroid::inverse
