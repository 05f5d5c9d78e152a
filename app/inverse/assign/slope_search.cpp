// SPDX-License-Identifier: Apache-2.0
// Light of a candidate is the product of a part along x and a part along y. So a row of candidates first sums the cells' lack along y,
// once for all of them, and then each sums a few numbers along x.
#include "inverse/assign/slope_search.h"

#include "inverse/assign/footprint.h"
#include "inverse/bending.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::inverse {
namespace {

/// At most so many points across: more cost time and tell little.
constexpr int most_points = 64;

/// Width of a flat facet's beam on a receiver; a lamp's light spreads.
double flat_beam(const Layout& layout, std::size_t receiver, int axis)
{
  const double lamp = layout.lamp ? layout.distances[receiver] / (layout.lamp->z - layout.thickness + layout.thickness / layout.n) : 0;
  return layout.facet()[axis] * (1 + lamp);
}

/// How many cells a beam can touch.
int taps(const Layout& layout, std::size_t receiver, int axis)
{
  constexpr double most = 1e7; // no memory holds a rim of so many
  const double wide = flat_beam(layout, receiver, axis) + blur_width(layout, layout.distances[receiver]);
  return 1 + static_cast<int>(std::min(most, std::ceil(wide / layout.cell()[axis])));
}

int rim_of(const Layout& layout, std::size_t receiver) { return std::max(taps(layout, receiver, 0), taps(layout, receiver, 1)); }

} // namespace

/// The beams of all points of the lattice along one axis.
struct SlopeSearch::Columns {
  std::vector<int> first;    ///< cell of each point, counted from the rim's first
  std::vector<float> parts;  ///< [tap][point]
  std::vector<float> square; ///< sum of the parts' squares
};

SlopeSearch::SlopeSearch(const Layout& layout, std::span<const double> weights, const std::vector<double>& heights)
    : layout_(layout), weights_(weights.begin(), weights.end()), heights_(heights),
      lattice_(glm::min(layout.cells, glm::ivec2(most_points)))
{
}

std::vector<Lack> SlopeSearch::lacks(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light) const
{
  std::vector<Lack> all;
  const glm::ivec2 cells = layout_.cells;
  for (std::size_t j = 0; j < light.size(); ++j) {
    const int rim = rim_of(layout_, j), width = cells.x + 2 * rim;
    Lack lack{rim, width, std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(cells.y + 2 * rim))};
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        const std::size_t cell = index_at(x, y, cells.x);
        const double over = light[j][cell] - static_cast<double>(layout_.facet_count()) * targets[j][cell];
        lack.values[index_at(x + rim, y + rim, width)] = static_cast<float>(2 * weights_[j] * over);
      }
    all.push_back(std::move(lack));
  }
  return all;
}

double SlopeSearch::point(int i, int axis) const
{
  const double step = layout_.receiver[axis] / lattice_[axis];
  return (i + 0.5) * step - layout_.receiver[axis] / 2;
}

SlopeSearch::Columns SlopeSearch::columns(std::size_t receiver, double from, double height, int axis) const
{
  const int count = taps(layout_, receiver, axis), points = lattice_[axis], cells = layout_.cells[axis], rim = rim_of(layout_, receiver);
  const double cell = layout_.cell()[axis], way = (layout_.distances[receiver] + height) / (layout_.distances.back() + height);
  Columns made{std::vector<int>(static_cast<std::size_t>(points)),
               std::vector<float>(static_cast<std::size_t>(points) * static_cast<std::size_t>(count)),
               std::vector<float>(static_cast<std::size_t>(points))};
  Beam beam{0, flat_beam(layout_, receiver, axis) / cell, blur_width(layout_, layout_.distances[receiver]) / cell};
  for (int i = 0; i < points; ++i) {
    const double at = from + (point(i, axis) - from) * way, half = layout_.receiver[axis] / 2;
    beam.middle = (axis == 0 ? at + half : half - at) / cell;
    const int first = std::clamp(static_cast<int>(std::floor(beam.middle - (beam.width + beam.blur) / 2)), -rim, cells + rim - count);
    made.first[static_cast<std::size_t>(i)] = first + rim;
    double before = part_before(beam, first);
    for (int tap = 0; tap < count; ++tap) {
      const double after = part_before(beam, first + tap + 1), part = after - before;
      made.parts[index_at(i, tap, points)] = static_cast<float>(part);
      made.square[static_cast<std::size_t>(i)] += static_cast<float>(part * part);
      before = after;
    }
  }
  return made;
}

void SlopeSearch::add_scores(std::size_t receiver, std::size_t facet, const Lack& lack, std::vector<float>& scores) const
{
  const glm::dvec2 from = layout_.middle(facet);
  const double height = heights_[facet];
  const Columns x = columns(receiver, from.x, height, 0), y = columns(receiver, from.y, height, 1);
  const auto width = static_cast<std::size_t>(lack.width), across = x.first.size(), down = y.first.size();
  const std::size_t taps_x = x.parts.size() / across, taps_y = y.parts.size() / down;
  const auto weight = static_cast<float>(weights_[receiver]);
  std::vector<float> row(width);
  for (std::size_t k = 0; k < down; ++k) {
    std::fill(row.begin(), row.end(), 0.0f);
    for (std::size_t tap = 0; tap < taps_y; ++tap) {
      const float part = y.parts[tap * down + k];
      const float* const cells = lack.values.data() + (static_cast<std::size_t>(y.first[k]) + tap) * width;
      for (std::size_t c = 0; c < width; ++c) row[c] += part * cells[c];
    }
    float* const score = scores.data() + k * across;
    const float square = weight * y.square[k];
    for (std::size_t i = 0; i < across; ++i) score[i] += square * x.square[i];
    for (std::size_t tap = 0; tap < taps_x; ++tap) {
      const float* const part = x.parts.data() + tap * across;
      for (std::size_t i = 0; i < across; ++i) score[i] += part[i] * row[static_cast<std::size_t>(x.first[i]) + tap];
    }
  }
}

std::optional<glm::dvec2> SlopeSearch::best(std::size_t facet, std::span<const Lack> lacks) const
{
  const auto across = static_cast<std::size_t>(lattice_.x), down = static_cast<std::size_t>(lattice_.y);
  const glm::dvec2 from = layout_.middle(facet);
  std::vector<float> scores(across * down);
  for (std::size_t j = 0; j < lacks.size(); ++j) add_scores(j, facet, lacks[j], scores);
  const glm::dvec2 sines = layout_.sines_on(facet);
  const double last = layout_.distances.back() + heights_[facet];
  float lowest = std::numeric_limits<float>::infinity();
  std::optional<glm::dvec2> found;
  for (std::size_t k = 0; k < down; ++k) {
    const double slope_y = (point(static_cast<int>(k), 1) - from.y) / last;
    for (std::size_t i = 0; i < across; ++i) {
      if (!(scores[k * across + i] < lowest)) continue;
      const glm::dvec2 slope{(point(static_cast<int>(i), 0) - from.x) / last, slope_y};
      if (!reachable(slope, layout_.n, sines, layout_.steepest)) continue;
      lowest = scores[k * across + i];
      found = slope;
    }
  }
  return found;
}

} // namespace nephroid::inverse
