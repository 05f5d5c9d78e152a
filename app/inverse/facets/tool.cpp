// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/tool.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// A facet as the tool sees it, which comes from -z: heights are -z.
struct Top {
  glm::dvec2 middle, half, gradient;
  double height;
  double at(const glm::dvec2& p) const { return height + glm::dot(gradient, p - middle); }
};

Top top_of(const Layout& layout, const Solid& solid, int column, int row) {
  const std::size_t i = index_at(column, row, layout.facets.x);
  return {layout.middle(i), layout.facet() / 2.0, -solid.facets[i].gradient, -solid.facets[i].height};
}

/// How deep the middle of a ball over p may go before the ball meets the facet's edge at `side` of the axis `across`:
/// greatest over the edge of its height plus sqrt(radius^2 - distance^2).
double over_edge(const Top& top, const glm::dvec2& p, double radius, int across, double side) {
  const int along = 1 - across;
  glm::dvec2 foot = p;
  foot[across] = top.middle[across] + side * top.half[across];
  const double away = p[across] - foot[across], in_line = radius * radius - away * away;
  if (in_line <= 0) return nowhere;
  const double slope = top.gradient[along], best = slope * std::sqrt(in_line / (1 + slope * slope)),
               from_middle = p[along] - top.middle[along],
               t = std::clamp(best, -top.half[along] - from_middle, top.half[along] - from_middle);
  if (t * t >= in_line) return nowhere;
  foot[along] += t;
  return top.at(foot) + std::sqrt(in_line - t * t);
}

double over_facet(const Top& top, const glm::dvec2& p, double radius) {
  const double length = std::sqrt(1 + glm::dot(top.gradient, top.gradient));
  const glm::dvec2 touches = glm::abs(p + radius / length * top.gradient - top.middle);
  if (touches.x <= top.half.x && touches.y <= top.half.y) return top.at(p) + radius * length;
  return std::max(std::max(over_edge(top, p, radius, 0, -1), over_edge(top, p, radius, 0, 1)),
                  std::max(over_edge(top, p, radius, 1, -1), over_edge(top, p, radius, 1, 1)));
}

} // namespace

double unreached_part(const Layout& layout, const Solid& solid, double radius) {
  constexpr int most_a_side = 64, least_points = 8;
  const std::vector<std::size_t> sample = some_facets(layout, most_a_side);
  const int points = std::max(least_points, 512 / std::max(layout.facets.x, layout.facets.y));
  const double slack = 1e-9 * radius;
  std::vector<std::size_t> unreached(sample.size());
  for_blocks(sample.size(), [&](std::size_t s) {
    const int column = static_cast<int>(sample[s]) % layout.facets.x,
              row = static_cast<int>(sample[s]) / layout.facets.x;
    const Top own = top_of(layout, solid, column, row);
    std::vector<Top> around;
    for (int y = std::max(0, row - 1); y <= std::min(layout.facets.y - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(layout.facets.x - 1, column + 1); ++x)
        if (x != column || y != row) around.push_back(top_of(layout, solid, x, y));
    const double length = std::sqrt(1 + glm::dot(own.gradient, own.gradient));
    for (int y = 0; y < points; ++y)
      for (int x = 0; x < points; ++x) {
        const glm::dvec2 q = own.middle +
                             own.half * ((glm::dvec2(x, y) + 0.5) * 2.0 / static_cast<double>(points) - 1.0),
                         p = q - radius / length * own.gradient; // the ball that touches q has its middle over p
        const double middle = own.at(q) + radius / length;
        unreached[s] += std::any_of(around.begin(), around.end(),
                                    [&](const Top& other) { return over_facet(other, p, radius) > middle + slack; })
                            ? 1
                            : 0;
      }
  });
  const auto count = static_cast<double>(std::accumulate(unreached.begin(), unreached.end(), std::size_t{0}));
  return count / (static_cast<double>(sample.size()) * points * points);
}

namespace {

/// The larger of the surface's principal curvatures, up from -z: eigenvalues of the second fundamental form over the
/// first.
double most_curved(const Surface& surface, const glm::dvec2& p) {
  const Surface::At at = surface.at(p);
  const double length2 = 1 + glm::dot(at.gradient, at.gradient);
  const glm::dmat2 first = glm::dmat2(1) + glm::outerProduct(at.gradient, at.gradient),
                   shape = glm::inverse(first) * (-at.curvature / std::sqrt(length2));
  const double mean = (shape[0][0] + shape[1][1]) / 2;
  return mean + std::sqrt(std::max(0.0, mean * mean - glm::determinant(shape)));
}

} // namespace

Valley tightest_valley(const Layout& layout, const Surface& surface) {
  constexpr double flat = 1e-6;             // 1 / mm
  constexpr int a_facet = 2, halvings = 12; // samples across a facet, its corners too; steps from the best
  struct Place {
    double curvature = flat;
    glm::dvec2 at{0};
  };
  const auto take_tighter = [&](Place& best, const glm::dvec2& p) {
    if (layout.is_beside(p) || glm::any(glm::greaterThan(glm::abs(p), layout.size / 2.0))) return false;
    const double curvature = most_curved(surface, p);
    if (curvature <= best.curvature) return false;
    best = {curvature, p};
    return true;
  };
  std::vector<Place> rows(static_cast<std::size_t>(a_facet * layout.facets.y) + 1);
  for_blocks(rows.size(), [&](std::size_t row) {
    for (int column = 0; column <= a_facet * layout.facets.x; ++column)
      take_tighter(rows[row], layout.corner(column / (1.0 * a_facet), static_cast<double>(row) / a_facet));
  });
  Place best = *std::ranges::max_element(rows, {}, &Place::curvature);
  if (best.curvature <= flat) return {};
  glm::dvec2 step = layout.facet() / (2.0 * a_facet);
  for (int i = 0; i < halvings; ++i, step /= 2.0)
    for (bool moved = true; moved;) {
      moved = false;
      for (const glm::dvec2& side : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        moved |= take_tighter(best, best.at + side * step);
    }
  return {1 / best.curvature, best.at};
}

} // namespace nephroid::inverse
