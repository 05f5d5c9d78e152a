// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/footprint.h"

#include "inverse/bending.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

double half_square(double t) { return t > 0 ? t * t / 2 : 0; }

/// The parts of the cells of a row of `cells` that a beam covers.
std::vector<double> parts(const Beam& beam, int cells, int& first)
{
  const double reach = (beam.width + beam.blur) / 2;
  first = std::clamp(static_cast<int>(std::floor(beam.middle - reach)), 0, cells);
  const int last = std::clamp(static_cast<int>(std::ceil(beam.middle + reach)), first, cells);
  std::vector<double> all;
  double before = part_before(beam, first);
  for (int i = first; i < last; ++i) {
    const double after = part_before(beam, i + 1);
    all.push_back(after - before);
    before = after;
  }
  return all;
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
  const glm::dvec2 g = facet_gradient(slope, layout.n), size = layout.facet(), cell = layout.cell();
  const double distance = layout.distances[receiver] + height, blur = blur_width(layout, distance);
  const glm::dvec2 at = layout.in_cells(layout.middle(facet) + slope * distance);
  const Beam along_x{at.x, std::abs(1 + slope.x * g.x) * size.x / cell.x, std::hypot(slope.x * g.y * size.y, blur) / cell.x};
  const Beam along_y{at.y, std::abs(1 + slope.y * g.y) * size.y / cell.y, std::hypot(slope.y * g.x * size.x, blur) / cell.y};
  Footprint made;
  made.x = parts(along_x, layout.cells.x, made.x0);
  made.y = parts(along_y, layout.cells.y, made.y0);
  return made;
}

double facet_power(const glm::dvec2& slope, double n) { return transmitted(slope, n) / transmitted({0, 0}, n); }

void add_light(const Layout& layout, std::size_t facet, const glm::dvec2& slope, double sign, std::vector<std::vector<double>>& light,
               double height)
{
  const double power = sign * facet_power(slope, layout.n);
  for (std::size_t j = 0; j < light.size(); ++j)
    for_cells(layout, footprint(layout, facet, slope, j, height), [&](std::size_t cell, double part) { light[j][cell] += power * part; });
}

double light_sent(const std::vector<glm::dvec2>& slopes, double n)
{
  double sum = 0;
  for (const glm::dvec2& slope : slopes) sum += facet_power(slope, n);
  return sum;
}

} // namespace nephroid::inverse
