// SPDX-License-Identifier: Apache-2.0
#include "inverse/thesis/adjust.h"

#include "base/parallel.h"
#include "inverse/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

constexpr int facets_a_side = 128;
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// Along one axis: which parts of which old cells a new cell is made of.
struct Source {
  int first = 0;
  std::vector<double> parts;
};

std::vector<Source> sources(int cells, double scale, double shift) {
  std::vector<Source> all;
  for (int i = 0; i < cells; ++i) {
    const auto old = [&](double at) {
      return std::clamp((at - (0.5 + shift) * cells) / scale + 0.5 * cells, 0.0, double(cells));
    };
    const double low = old(i), high = old(i + 1);
    Source source{static_cast<int>(low), {}};
    for (int k = source.first; k < high; ++k)
      source.parts.push_back((std::min(high, k + 1.0) - std::max(low, double(k))) * scale);
    all.push_back(std::move(source));
  }
  return all;
}

/// What a missing cell's light meets at one other receiver.
struct OtherReceiver {
  double farthest = 0; ///< cells
  std::uint64_t on = 0, beside = 0;
};

class Projection {
public:
  Projection(const Layout& layout, const std::vector<SamplingTarget>& aims, const std::vector<Margin>& margins)
      : layout_(layout), aims_(aims), margins_(margins) {
    for (const std::size_t facet : some_facets(layout, facets_a_side)) {
      facets_.push_back(layout.middle(facet));
      sines_.push_back(layout.sines_on(facet));
    }
  }

  /// Light through a lit cell of picture `a`. Empty: the cell is not missing.
  std::vector<OtherReceiver> through(std::size_t a, std::size_t cell) const {
    const glm::dvec2 to = layout_.middle_of_cell(cell);
    std::vector<OtherReceiver> met(aims_.size());
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      const glm::dvec2 from = facets_[i], slope = (to - from) / aims_[a].distance;
      if (!reachable(slope, layout_.n, sines_[i], layout_.steepest)) continue;
      bool all = true;
      for (std::size_t b = 0; b < aims_.size(); ++b) {
        if (b == a) continue;
        const std::optional<std::size_t> there = layout_.cell_at(from + slope * aims_[b].distance);
        ++(there ? met[b].on : met[b].beside);
        const double distance = there ? margins_[b].distance[*there] : 0;
        met[b].farthest = std::max(met[b].farthest, distance);
        all = all && there && distance == 0;
      }
      if (all) return {};
    }
    return met;
  }

private:
  const Layout& layout_;
  const std::vector<SamplingTarget>& aims_;
  const std::vector<Margin>& margins_;
  std::vector<glm::dvec2> facets_, sines_; ///< middles, and the light that falls there
};

} // namespace

std::vector<double> moved(const Target& picture, const Layout& layout, double scale, const glm::dvec2& shift) {
  const std::vector<Source> x = sources(layout.cells.x, scale, shift.x), y = sources(layout.cells.y, scale, shift.y);
  const auto columns = static_cast<std::size_t>(layout.cells.x);
  std::vector<double> made;
  made.reserve(picture.size());
  for (const Source& row : y)
    for (const Source& column : x) {
      double sum = 0;
      for (std::size_t k = 0; k < row.parts.size(); ++k)
        for (std::size_t i = 0; i < column.parts.size(); ++i)
          sum +=
              row.parts[k] * column.parts[i] *
              picture[(static_cast<std::size_t>(row.first) + k) * columns + static_cast<std::size_t>(column.first) + i];
      made.push_back(sum);
    }
  const double most = *std::max_element(made.begin(), made.end());
  if (most > 0)
    for (double& value : made) value /= most;
  return made;
}

/// First along columns, then along rows: exact, since a squared distance is a sum of both.
Margin margin_of(const std::vector<double>& picture, const Layout& layout) {
  const auto columns = static_cast<std::size_t>(layout.cells.x), rows = static_cast<std::size_t>(layout.cells.y);
  std::vector<std::size_t> in_column(picture.size(), nowhere); // row of the nearest lit cell of the column
  for (std::size_t x = 0; x < columns; ++x) {
    std::size_t lit = nowhere;
    for (std::size_t y = 0; y < rows; ++y) {
      if (picture[y * columns + x] > 0) lit = y;
      in_column[y * columns + x] = lit;
    }
    lit = nowhere;
    for (std::size_t y = rows; y-- > 0;) {
      if (picture[y * columns + x] > 0) lit = y;
      std::size_t& nearest = in_column[y * columns + x];
      if (lit != nowhere && (nearest == nowhere || lit - y < y - nearest)) nearest = lit;
    }
  }
  Margin margin{std::vector<double>(picture.size(), std::numeric_limits<double>::infinity()),
                std::vector<std::size_t>(picture.size())};
  for_blocks(rows, [&](std::size_t y) {
    for (std::size_t x = 0; x < columns; ++x)
      for (std::size_t other = 0; other < columns; ++other) {
        const std::size_t row = in_column[y * columns + other];
        if (row == nowhere) continue;
        const double across = static_cast<double>(x) - static_cast<double>(other),
                     down = static_cast<double>(y) - static_cast<double>(row);
        const double squared = across * across + down * down;
        if (squared >= margin.distance[y * columns + x]) continue;
        margin.distance[y * columns + x] = squared;
        margin.nearest[y * columns + x] = row * columns + other;
      }
  });
  for (double& distance : margin.distance) distance = std::sqrt(distance);
  return margin;
}

std::vector<double> extended(const std::vector<double>& picture, const Margin& margin, double cells) {
  std::vector<double> made = picture;
  for (std::size_t i = 0; i < made.size(); ++i)
    if (margin.distance[i] > 0 && margin.distance[i] <= cells)
      made[i] = picture[margin.nearest[i]] * (1 - margin.distance[i] / (cells + 1));
  return made;
}

std::vector<MissingLight> needs_of(const Layout& layout, const std::vector<SamplingTarget>& aims,
                                   const std::vector<Margin>& margins) {
  const Projection projection(layout, aims, margins);
  std::vector<MissingLight> needs(aims.size());
  std::vector<OtherReceiver> sums(aims.size());
  for (std::size_t a = 0; a < aims.size(); ++a) {
    std::vector<std::vector<OtherReceiver>> found(layout.cell_count());
    for_ranges(found.size(), 16, [&](std::size_t, Range range) {
      for (std::size_t cell = range.begin; cell < range.end; ++cell)
        if (margins[a].distance[cell] == 0) found[cell] = projection.through(a, cell);
    });
    for (const std::vector<OtherReceiver>& met : found) {
      if (!met.empty()) ++needs[a].missing;
      for (std::size_t b = 0; b < met.size(); ++b) {
        sums[b].farthest = std::max(sums[b].farthest, met[b].farthest);
        sums[b].on += met[b].on;
        sums[b].beside += met[b].beside;
      }
    }
  }
  for (std::size_t b = 0; b < aims.size(); ++b) {
    const auto all = static_cast<double>(sums[b].on + sums[b].beside);
    needs[b].extension = sums[b].farthest;
    needs[b].overshoot = all > 0 ? static_cast<double>(sums[b].beside) / all : 0;
  }
  return needs;
}

} // namespace nephroid::inverse
