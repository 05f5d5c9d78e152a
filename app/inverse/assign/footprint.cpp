// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/footprint.h"

#include "base/parallel.h"
#include "inverse/bending.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

double half_square(double t) { return t > 0 ? t * t / 2 : 0; }

/// The parts of the cells of a row of `cells` that a beam covers.
std::vector<double> parts(const Beam& beam, int cells, int& first)
{
  const double reach = (beam.width + beam.blur) / 2;
  const double end = cells; // far off no int would hold the cell
  first = static_cast<int>(std::clamp(std::floor(beam.middle - reach), 0.0, end));
  const int last = static_cast<int>(std::clamp(std::ceil(beam.middle + reach), static_cast<double>(first), end));
  std::vector<double> covered;
  double before = part_before(beam, first);
  for (int i = first; i < last; ++i) {
    const double after = part_before(beam, i + 1);
    covered.push_back(after - before);
    before = after;
  }
  return covered;
}

/// The part of a facet whose light reaches the receivers: its middle and size in parts of the facet.
struct LitPart {
  glm::dvec2 middle{0}, size{1};
};

/// inside: the slope of the light in the object. g: the facet's gradient.
LitPart lit_part(const Incoming& in, const glm::dvec2& inside, const glm::dvec2& slope, const glm::dvec2& g)
{
  const glm::dvec2 step = (g + in.around) / 2.0;
  const glm::dvec2 shadow = glm::max(inside * step, glm::dvec2(0)) / std::max(0.1, 1 + glm::dot(inside, g));
  const glm::dvec2 stopped = glm::max(slope * step, glm::dvec2(0)) / std::max(0.1, 1 + glm::dot(slope, g));
  return {(glm::sign(inside) * shadow - glm::sign(slope) * stopped) / 2.0, glm::max(1.0 - shadow - stopped, glm::dvec2(0))};
}

double index_variance(const Layout& layout)
{
  double sum = 0;
  for (const double n : layout.indices) sum += (n - layout.n) * (n - layout.n);
  return layout.indices.empty() ? 0 : sum / static_cast<double>(layout.indices.size());
}

} // namespace

double part_before(const Beam& beam, double t)
{
  const double a = std::max(beam.width, beam.blur), b = std::min(beam.width, beam.blur), at = t - beam.middle;
  if (b < 1e-6 * a) return std::clamp(at / a + 0.5, 0.0, 1.0); // the difference below would be rounding
  const double sum =
      half_square(at + (a + b) / 2) - half_square(at + (a - b) / 2) - half_square(at - (a - b) / 2) + half_square(at - (a + b) / 2);
  return std::clamp(sum / (a * b), 0.0, 1.0);
}

double blur_width(const Layout& layout, double distance)
{
  const double sun = layout.sun_radius * distance / 2, rough = layout.scatter * distance;
  return std::sqrt(12 * (sun * sun + rough * rough));
}

Footprint footprint(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver, double height)
{
  const Incoming in = layout.incoming.empty() ? Incoming{} : layout.incoming[facet];
  const glm::dvec2 g = facet_gradient(slope, layout.n, in.sines), size = layout.facet(), cell = layout.cell();
  const double distance = layout.distances[receiver] + height;
  glm::dmat2 map = glm::dmat2(1) + glm::outerProduct(slope, g);
  LitPart lit;
  glm::dvec2 variance(layout.scatter * layout.scatter); // of the slope, along x and along y
  if (!layout.incoming.empty()) {
    const glm::dvec2 inside = slope_inside(in.sines, layout.n);
    if (!layout.free_heights) lit = lit_part(in, inside, slope, g);
    if (layout.lamp)
      map += distance * slope_change(slope, layout.n, in.sines).by_sines * in.spread * (glm::dmat2(1) + glm::outerProduct(inside, g));
  }
  if (layout.sun_radius > 0 || !layout.indices.empty()) {
    const SlopeChange change = slope_change(slope, layout.n, in.sines);
    const glm::dvec2 by_x = glm::row(change.by_sines, 0), by_y = glm::row(change.by_sines, 1);
    // The disc is across the light: of its radius r, sines have the covariance r^2 / 4 (1 - sines sines^T).
    const auto disc = [&](const glm::dvec2& by) {
      const double along = glm::dot(by, in.sines);
      return layout.sun_radius * layout.sun_radius / 4 * (glm::dot(by, by) - along * along);
    };
    variance += glm::dvec2(disc(by_x), disc(by_y)) + index_variance(layout) * change.by_index * change.by_index;
  }
  const glm::dvec2 at = layout.in_cells(layout.middle(facet) + map * (lit.middle * size) + slope * distance),
                   blur = 12.0 * distance * distance * variance;
  const auto beam = [&](int axis) {
    const int other = 1 - axis;
    const double across = map[other][axis] * lit.size[other] * size[other];
    return Beam{at[axis], std::abs(map[axis][axis]) * lit.size[axis] * size[axis] / cell[axis],
                std::sqrt(across * across + blur[axis]) / cell[axis]};
  };
  Footprint print;
  print.x = parts(beam(0), layout.cells.x, print.x0);
  print.y = parts(beam(1), layout.cells.y, print.y0);
  return print;
}

double facet_power(const Layout& layout, std::size_t facet, const glm::dvec2& slope)
{
  const double n = layout.n;
  if (layout.incoming.empty()) return transmitted(slope, n) / transmitted({0, 0}, n);
  const Incoming& in = layout.incoming[facet];
  const glm::dvec2 g = facet_gradient(slope, n, in.sines), inside = slope_inside(in.sines, n);
  const glm::dvec2 lit = layout.free_heights ? glm::dvec2(1) : lit_part(in, inside, slope, g).size;
  return in.power * (1 + glm::dot(inside, g)) * lit.x * lit.y * transmitted(slope, n, in.sines) / transmitted({0, 0}, n);
}

void add_light(const Layout& layout, std::size_t facet, const glm::dvec2& slope, double sign, std::vector<std::vector<double>>& light,
               double height)
{
  const double power = sign * facet_power(layout, facet, slope);
  for (std::size_t j = 0; j < light.size(); ++j)
    for_cells(layout, footprint(layout, facet, slope, j, height), [&](std::size_t cell, double part) { light[j][cell] += power * part; });
}

void light_all(const Layout& layout, const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights,
               std::vector<std::vector<double>>& light)
{
  for_blocks(light.size(), [&](std::size_t j) {
    std::fill(light[j].begin(), light[j].end(), 0.0);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const double power = facet_power(layout, i, slopes[i]);
      for_cells(layout, footprint(layout, i, slopes[i], j, heights[i]),
                [&](std::size_t cell, double part) { light[j][cell] += power * part; });
    }
  });
}

double light_sent(const Layout& layout, const std::vector<glm::dvec2>& slopes)
{
  double sum = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) sum += facet_power(layout, i, slopes[i]);
  return sum;
}

} // namespace nephroid::inverse
