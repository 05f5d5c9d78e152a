// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/footprint.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/lamp.h"
#include "inverse/light.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

double half_square(double t) { return t > 0 ? t * t / 2 : 0; }

/// The first of a row of cells that beams between two places can touch, and the one behind the last, however far off.
glm::ivec2 touched(double from, double to, int cells) {
  const double end = cells, first = std::clamp(std::floor(from), 0.0, end);
  return {static_cast<int>(first), static_cast<int>(std::clamp(std::ceil(to), first, end))};
}

/// The part of a facet whose light reaches the receivers: its middle and size in parts of the facet.
struct LitPart {
  glm::dvec2 middle{0}, size{1};
};

/// The mean over v = -1/2 .. 1/2 of a + b v where that is above 0.
double mean_above_0(double a, double b) {
  b = std::abs(b);
  return std::abs(a) >= b / 2 ? std::max(a, 0.0) : (a + b / 2) * (a + b / 2) / (2 * b);
}

/// `inside` is the slope of the light in the object, g the facet's gradient.
LitPart lit_part(const Layout& layout, std::size_t facet, const glm::dvec2& inside, const glm::dvec2& slope,
                 const glm::dvec2& g) {
  const auto columns = static_cast<std::size_t>(layout.facets.x);
  const glm::ivec2 at(facet % columns, facet / columns);
  const glm::dvec2 size = layout.facet();
  // What the neighbour at a side hides of light with this slope, in parts of the facet's width.
  const auto hidden = [&](const glm::dvec2& light, int axis, int side) {
    glm::ivec2 to = at;
    to[axis] += axis == 0 ? side : -side; // rows count downwards
    if (to.x < 0 || to.y < 0 || to.x >= layout.facets.x || to.y >= layout.facets.y) return 0.0;
    const glm::dvec2 h = layout.incoming()[index_at(to.x, to.y, layout.facets.x)].around;
    const int other = 1 - axis;
    return mean_above_0(light[axis] * (g[axis] + h[axis]) / 2,
                        light[axis] * (g[other] - h[other]) * size[other] / size[axis]) /
           std::max(0.1, 1 + glm::dot(light, g));
  };
  LitPart lit;
  for (int axis = 0; axis < 2; ++axis) {
    const int from = layout.n * inside[axis] > 0 ? -1 : 1, // light before a mirror comes from the other side
        towards = slope[axis] > 0 ? 1 : -1;
    const double shadow = hidden(inside, axis, from), stopped = hidden(slope, axis, towards);
    lit.middle[axis] = -(from * shadow + towards * stopped) / 2;
    lit.size[axis] = std::max(0.0, 1 - shadow - stopped);
  }
  return lit;
}

/// A blur in slopes: shifts of parts of the light, and the variance along x and along y that is left of each.
struct Blur {
  int count = 1;
  std::array<glm::dvec2, Beams::most> shifts{};
  std::array<double, Beams::most> parts{1};
  glm::dvec2 variance{0};
};

/// The line of indices in as many pieces as it takes for each to be short beside a cell.
void part_colours(const Layout& layout, const glm::dvec2& by_index, double longest, int most, Blur& blur) {
  const double length = glm::length(by_index) * index_spread(layout);
  int count = 1;
  while (2 * count <= most && length > longest * count) count *= 2;
  const IndexGroups groups = index_groups(layout, count);
  for (std::size_t k = 0; k < groups.over.size(); ++k) blur.shifts[k] = groups.over[k] * by_index;
  std::copy(groups.parts.begin(), groups.parts.end(), blur.parts.begin());
  blur.count = count;
  blur.variance += groups.within * by_index * by_index;
}

/// Each beam becomes one for each point; `to_slope` makes of a point the change of the slope.
void part_width(const glm::dmat3x2& to_slope, const LightPoints& points, Blur& blur) {
  const int count = static_cast<int>(points.at.size());
  for (int k = blur.count - 1; k >= 0; --k) {
    const glm::dvec2 middle = blur.shifts[static_cast<std::size_t>(k)];
    const double part = blur.parts[static_cast<std::size_t>(k)] / count;
    for (int i = 0; i < count; ++i) {
      blur.shifts[index_at(i, k, count)] = middle + to_slope * points.at[static_cast<std::size_t>(i)];
      blur.parts[index_at(i, k, count)] = part;
    }
  }
  blur.count *= count;
  const glm::dmat2 left = to_slope * points.left * glm::transpose(to_slope);
  blur.variance += glm::dvec2(left[0][0], left[1][1]);
}

/// The variance of the slope by diffraction. Beams leave a facet as wide as it looks along them.
glm::dvec2 wave_variance(const Layout& layout, const glm::dvec2& slope, const glm::dvec2& g) {
  const glm::dmat2 map = glm::dmat2(1) + glm::outerProduct(slope, g);
  const glm::dmat2 by_cosines = std::sqrt(1 + glm::dot(slope, slope)) *
                                (glm::dmat2(1) + glm::outerProduct(slope, slope)) * glm::inverse(glm::transpose(map));
  const glm::dvec2 x = by_cosines[0] * layout.wave_width().x, y = by_cosines[1] * layout.wave_width().y;
  return (x * x + y * y) / 12.0;
}

/// `fine` is a cell as a slope.
Blur blur_of(const Layout& layout, const Illumination& light, const Incoming& in, const glm::dvec2& slope,
             double fine) {
  Blur blur;
  if (!layout.blurs()) return blur;
  const SlopeChange change = slope_change(slope, layout.n, in.sines);
  // The disc is across the light: of its radius r, sines have the covariance r^2 / 4 (1 - sines sines^T).
  const double sun = layout.disc(light) / 2, cosine = std::sqrt(1 - glm::dot(in.sines, in.sines));
  const glm::dmat2 disc =
      sun * change.by_sines * (glm::dmat2(1) - glm::outerProduct(in.sines, in.sines) / (1 + cosine));
  const glm::dmat2 of_lamp = change.by_sines * in.spread, lamp = of_lamp * root_of_places(light, in.sines),
                   rough(layout.scatter * layout.scatter),
                   both = disc * glm::transpose(disc) + lamp * glm::transpose(lamp) + rough; // covariance
  const bool is_wide = std::sqrt(12 * (both[0][0] + both[1][1]) / 2) > wide_in_cells * fine;
  if (layout.spectrum)
    part_colours(layout, change.by_index, piece_in_cells * fine, is_wide ? Beams::most / 4 : Beams::most, blur);
  const LightPoints& points = points_of(light, blur.count > 1);
  if (!is_wide)
    blur.variance += glm::dvec2(both[0][0], both[1][1]);
  else if (light.lamp_places.empty())
    part_width(glm::dmat3x2(lower_root(both)), points, blur);
  else { // a lamp has a size of its own instead of the sun's
    part_width(of_lamp * seen_along(in.sines), points, blur);
    blur.variance += glm::dvec2(rough[0][0], rough[1][1]);
  }
  blur.variance += wave_variance(layout, slope, facet_gradient(slope, layout.n, in.sines));
  return blur;
}

/// The least and the greatest index, but for the ends of the spectrum.
glm::dvec2 index_ends(const Layout& layout) {
  constexpr double beyond = 1e-3;
  glm::dvec2 ends(std::numeric_limits<double>::infinity(), 0);
  double before = 0;
  for (const LightPart& piece : layout.parts()) {
    const double behind = before + piece.xyz.y;
    if (behind >= beyond && before <= 1 - beyond) ends = {std::min(ends[0], piece.n), std::max(ends[1], piece.n)};
    before = behind;
  }
  return layout.spectrum ? ends : glm::dvec2(layout.n);
}

} // namespace

double index_spread(const Layout& layout) {
  const glm::dvec2 ends = index_ends(layout);
  return ends[1] - ends[0];
}

IndexGroups index_groups(const Layout& layout, int count) {
  const auto groups_count = static_cast<std::size_t>(count);
  const glm::dvec2 ends = index_ends(layout);
  const double length = (ends[1] - ends[0]) / count;
  IndexGroups groups{std::vector<double>(groups_count), std::vector<double>(groups_count), 0};
  double squares = 0;
  for (const LightPart& piece : layout.parts()) {
    const double n = std::clamp(piece.n, ends[0], ends[1]), over = n - layout.n;
    const std::size_t k = length > 0 ? std::min(groups_count - 1, static_cast<std::size_t>((n - ends[0]) / length)) : 0;
    groups.over[k] += piece.xyz.y * over;
    groups.parts[k] += piece.xyz.y;
    squares += piece.xyz.y * over * over;
  }
  if (!layout.spectrum) groups.parts[0] = 1;
  for (std::size_t k = 0; k < groups_count; ++k) {
    if (groups.parts[k] > 0) groups.over[k] /= groups.parts[k];
    squares -= groups.parts[k] * groups.over[k] * groups.over[k];
  }
  groups.within = std::max(0.0, squares);
  return groups;
}

double part_before(const Beam& beam, double t) {
  const double a = std::max(beam.width, beam.blur), b = std::min(beam.width, beam.blur), at = t - beam.middle;
  if (b < 1e-6 * a) return std::clamp(at / a + 0.5, 0.0, 1.0); // the difference below would be rounding
  const double sum = half_square(at + (a + b) / 2) - half_square(at + (a - b) / 2) - half_square(at - (a - b) / 2) +
                     half_square(at - (a + b) / 2);
  return std::clamp(sum / (a * b), 0.0, 1.0);
}

double blur_width(const Layout& layout, std::size_t receiver) {
  const double distance = layout.distances[receiver], sun = layout.disc(layout.light_on(receiver)) * distance / 2,
               rough = layout.scatter * distance;
  return std::sqrt(12 * (sun * sun + rough * rough));
}

Beams beams_of(const Layout& layout, std::size_t facet, const glm::dvec2& of_all, std::size_t receiver, double height) {
  const LitFacet lit_now = lit_facet(layout, facet, of_all, receiver);
  const Incoming& in = lit_now.in;
  const glm::dvec2 slope = lit_now.slope, g = lit_now.gradient, size = layout.facet(), cell = layout.cell();
  const double distance = layout.distances[receiver] + height;
  const Blur blur = blur_of(layout, layout.light_on(receiver), in, slope, std::min(cell.x, cell.y) / distance);
  glm::dmat2 map = glm::dmat2(1) + glm::outerProduct(slope, g);
  LitPart lit;
  if (layout.light.facets) {
    const glm::dvec2 inside = slope_inside(in.sines, layout.n);
    if (!layout.free_heights) lit = lit_part(layout, facet, inside, slope, g);
    if (layout.light_on(receiver).lamp)
      map += distance * slope_change(slope, layout.n, in.sines).by_sines * in.spread *
             (glm::dmat2(1) + glm::outerProduct(inside, g));
  }
  const glm::dvec2 at = layout.in_cells(layout.middle(facet) - layout.offset(receiver) + map * (lit.middle * size) +
                                        slope * distance),
                   box = 12.0 * distance * distance * blur.variance;
  const auto beam = [&](int axis) {
    const int other = 1 - axis;
    const double across = map[other][axis] * lit.size[other] * size[other];
    return Beam{at[axis], std::abs(map[axis][axis]) * lit.size[axis] * size[axis] / cell[axis],
                std::sqrt(across * across + box[axis]) / cell[axis]};
  };
  Beams beams{beam(0), beam(1), blur.count, {}, blur.parts};
  for (int k = 0; k < blur.count; ++k)
    beams.shifts[static_cast<std::size_t>(k)] =
        blur.shifts[static_cast<std::size_t>(k)] * distance / glm::dvec2(cell.x, -cell.y);
  return beams;
}

Footprint footprint(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
                    double height) {
  const Beams beams = beams_of(layout, facet, slope, receiver, height);
  glm::dvec2 low = beams.shifts[0], high = low;
  for (int k = 1; k < beams.count; ++k) {
    low = glm::min(low, beams.shifts[static_cast<std::size_t>(k)]);
    high = glm::max(high, beams.shifts[static_cast<std::size_t>(k)]);
  }
  const glm::dvec2 middle(beams.x.middle, beams.y.middle),
      reach = glm::dvec2(beams.x.width + beams.x.blur, beams.y.width + beams.y.blur) / 2.0;
  low += middle - reach;
  high += middle + reach;
  const glm::ivec2 x = touched(low.x, high.x, layout.cells.x), y = touched(low.y, high.y, layout.cells.y);
  Footprint print{x[0], y[0], x[1] - x[0], y[1] - y[0], {}};
  print.cells.resize(static_cast<std::size_t>(print.columns) * static_cast<std::size_t>(print.rows));
  std::vector<double> row(static_cast<std::size_t>(print.columns));
  for (int k = 0; k < beams.count; ++k) {
    const glm::dvec2 shift = beams.shifts[static_cast<std::size_t>(k)];
    const auto before = [&](const Beam& beam, double moved, int cell) { return part_before(beam, cell - moved); };
    double last = before(beams.x, shift.x, print.x0);
    for (int i = 0; i < print.columns; ++i) {
      const double next = before(beams.x, shift.x, print.x0 + i + 1);
      row[static_cast<std::size_t>(i)] = (next - last) * beams.parts[static_cast<std::size_t>(k)];
      last = next;
    }
    last = before(beams.y, shift.y, print.y0);
    for (int j = 0; j < print.rows; ++j) {
      const double next = before(beams.y, shift.y, print.y0 + j + 1), part = next - last;
      last = next;
      if (part == 0) continue;
      double* const cells = print.cells.data() + index_at(0, j, print.columns);
      for (int i = 0; i < print.columns; ++i) cells[i] += part * row[static_cast<std::size_t>(i)];
    }
  }
  return print;
}

double facet_power(const Layout& layout, std::size_t facet, const glm::dvec2& of_all, std::size_t receiver) {
  const double n = layout.n;
  if (!layout.light.facets) return transmitted(of_all, n) / transmitted({0, 0}, n);
  const LitFacet light = lit_facet(layout, facet, of_all, receiver);
  if (!light.goes) return 0;
  const Incoming& in = light.in;
  const glm::dvec2 slope = light.slope, g = light.gradient, inside = slope_inside(in.sines, n);
  const glm::dvec2 lit = layout.free_heights ? glm::dvec2(1) : lit_part(layout, facet, inside, slope, g).size;
  return in.power * std::max(0.0, 1 + glm::dot(inside, g)) * lit.x * lit.y * transmitted(slope, n, in.sines) /
         transmitted({0, 0}, n);
}

std::vector<std::vector<double>> light_of_all(const Layout& layout, const std::vector<glm::dvec2>& slopes,
                                              const std::vector<double>& heights) {
  std::vector<std::vector<double>> light(layout.distances.size(), std::vector<double>(layout.cell_count()));
  for_blocks(light.size(), [&](std::size_t j) {
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const double power = facet_power(layout, i, slopes[i], j);
      for_cells(layout, footprint(layout, i, slopes[i], j, heights[i]),
                [&](std::size_t cell, double part) { light[j][cell] += power * part; });
    }
  });
  return light;
}

double light_sent(const Layout& layout, const std::vector<glm::dvec2>& slopes, std::size_t receiver) {
  double sum = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) sum += facet_power(layout, i, slopes[i], receiver);
  return sum;
}

std::vector<double> light_sent_to_each(const Layout& layout, const std::vector<glm::dvec2>& slopes) {
  std::vector<double> sent(layout.distances.size());
  for (std::size_t j = 0; j < sent.size(); ++j)
    sent[j] = j > 0 && layout.light_index(j) == layout.light_index(j - 1) ? sent[j - 1] : light_sent(layout, slopes, j);
  return sent;
}

} // namespace nephroid::inverse
