// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/cost.h"

#include "inverse/bending.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

template <class F>
void for_neighbours(const glm::ivec2& facets, std::size_t facet, const F& f) {
  const auto columns = static_cast<std::size_t>(facets.x), rows = static_cast<std::size_t>(facets.y);
  const std::size_t column = facet % columns, row = facet / columns;
  if (column > 0) f(facet - 1);
  if (column + 1 < columns) f(facet + 1);
  if (row > 0) f(facet - columns);
  if (row + 1 < rows) f(facet + columns);
}

} // namespace

Cost cost_of(const Target& t, std::span<const double> z, double sent) {
  constexpr double counts = 0.01;
  const double t_max = *std::max_element(t.begin(), t.end()), z_max = *std::max_element(z.begin(), z.end());
  const double t_sum = std::accumulate(t.begin(), t.end(), 0.0), z_sum = std::accumulate(z.begin(), z.end(), 0.0);
  const auto part = [](double value, double of) { return of > 0 ? value / of : 0; };
  double squares = 0, counted_squares = 0, l2 = 0, norm = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = t[i] / t_max, b = part(z[i], z_max), d = (a - b) * (a - b);
    squares += d;
    if (a + b > counts) {
      counted_squares += d;
      ++counted;
    }
    const double wanted = t[i] / t_sum, e = wanted - part(z[i], z_sum);
    l2 += e * e;
    norm += wanted * wanted;
  }
  return {std::sqrt(counted_squares / static_cast<double>(counted)), std::sqrt(squares / static_cast<double>(t.size())),
          std::sqrt(l2 / norm), sent > 0 ? 1 - z_sum / sent : 0};
}

std::vector<Cost> costs_of(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light,
                           std::span<const double> sent) {
  std::vector<Cost> costs;
  for (std::size_t j = 0; j < targets.size(); ++j) costs.push_back(cost_of(targets[j], light[j], sent[j]));
  return costs;
}

Cost mean(std::span<const Cost> costs) {
  Cost sum;
  for (const Cost& c : costs) {
    sum.cost += c.cost;
    sum.cost_all += c.cost_all;
    sum.rel_l2 += c.rel_l2;
    sum.missed += c.missed;
  }
  const double count = static_cast<double>(costs.size());
  return {sum.cost / count, sum.cost_all / count, sum.rel_l2 / count, sum.missed / count};
}

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

glm::dvec3 normal_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope) {
  return glm::normalize(glm::dvec3(facet_gradient(slope, layout.n, layout.sines_on(facet)), -1));
}

double roughness(const Layout& layout, const std::vector<glm::dvec2>& slopes) {
  double sum = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    glm::dvec3 around(0);
    double count = 0;
    for_neighbours(layout.facets, i, [&](std::size_t other) {
      around += normal_of(layout, other, slopes[other]);
      ++count;
    });
    if (count > 0) sum += 1 - glm::dot(normal_of(layout, i, slopes[i]), around) / count;
  }
  return sum / static_cast<double>(slopes.size());
}

} // namespace nephroid::inverse
