// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/conflicts.h"

#include "base/parallel.h"
#include "inverse/assign/cost.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {

ConflictSearch::ConflictSearch(const Layout& layout, const std::vector<Target>& targets,
                               const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights,
                               const std::vector<std::vector<double>>& light)
    : layout_(layout), slopes_(slopes), heights_(heights), light_(light), wanted_(targets), too_much_(light) {
  for (std::size_t j = 0; j < light.size(); ++j) {
    const double received = std::accumulate(light[j].begin(), light[j].end(), 0.0);
    for (std::size_t c = 0; c < light[j].size(); ++c) {
      too_much_[j][c] = light[j][c] > 0 ? std::max(0.0, 1 - received * targets[j][c] / light[j][c]) : 0;
      wanted_[j][c] *= received / static_cast<double>(layout.facet_count());
    }
  }
  weights_ = picture_weights(layout, wanted_);
}

double ConflictSearch::misplaced(std::size_t facet, std::size_t receiver) const {
  double well = 0;
  for_cells(layout_, footprint(layout_, facet, slopes_[facet], receiver, heights_[facet]),
            [&](std::size_t cell, double part) { well += part * (1 - too_much_[receiver][cell]); });
  return 1 - well;
}

std::vector<double> ConflictSearch::facet_conflicts() const {
  std::vector<double> most(slopes_.size());
  for_ranges(most.size(), 256, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t j = 0; j < light_.size() && !layout_.is_beside(layout_.middle(i)); ++j)
        most[i] = std::max(most[i], misplaced(i, j));
  });
  return most;
}

/// What a picture's weighted squares would change by with the facet at another slope.
double ConflictSearch::change(std::size_t facet, const glm::dvec2& slope, std::size_t receiver) const {
  std::vector<std::pair<std::size_t, double>> moves; // a cell, and how much it gets
  const auto move = [&](const glm::dvec2& to, double sign) {
    const double power = sign * facet_power(layout_, facet, to, receiver);
    for_cells(layout_, footprint(layout_, facet, to, receiver, heights_[facet]), [&](std::size_t cell, double part) {
      const auto known = std::find_if(moves.begin(), moves.end(), [&](const auto& m) { return m.first == cell; });
      if (known == moves.end())
        moves.emplace_back(cell, power * part);
      else
        known->second += power * part;
    });
  };
  move(slopes_[facet], -1);
  move(slope, 1);
  double sum = 0;
  for (const auto& [cell, gets] : moves)
    sum += gets * (2 * (light_[receiver][cell] - static_cast<double>(slopes_.size()) * wanted_[receiver][cell]) + gets);
  return weights_[receiver] * sum;
}

/// Places on a receiver, at most 64 a side, those first where a flat facet's light helps its picture most.
std::vector<glm::dvec2> ConflictSearch::best_places(std::size_t receiver) const {
  const glm::ivec2 cells = layout_.cells, step = (cells + 63) / 64;
  const double distance = layout_.distances[receiver],
               lamp =
                   layout_.light_on(receiver).lamp
                       ? distance / (layout_.light_on(receiver).lamp->z - layout_.entry() + layout_.entry() / layout_.n)
                       : 0;
  const auto parts = [&](int axis, int at) { // a beam on the middle of a cell: its first cell, and its part on each
    const double cell = layout_.cell()[axis], width = layout_.facet()[axis] * (1 + lamp) / cell,
                 blur = blur_width(layout_, receiver) / cell;
    const Beam beam{at + 0.5, width, blur};
    const int reach = static_cast<int>(std::min<double>(cells[axis], std::ceil((width + blur) / 2))),
              first = std::max(0, at - reach);
    std::vector<double> part;
    for (int c = first; c <= std::min(at + reach, cells[axis] - 1); ++c)
      part.push_back(part_before(beam, c + 1) - part_before(beam, c));
    return std::pair(first, part);
  };
  std::vector<std::pair<double, std::size_t>> places; // what it adds to the squares, and the cell
  for (int y = step.y / 2; y < cells.y; y += step.y)
    for (int x = step.x / 2; x < cells.x; x += step.x) {
      const auto across = parts(0, x), down = parts(1, y);
      double sum = 0;
      for (std::size_t k = 0; k < down.second.size(); ++k)
        for (std::size_t i = 0; i < across.second.size(); ++i) {
          const std::size_t cell =
              index_at(across.first + static_cast<int>(i), down.first + static_cast<int>(k), cells.x);
          sum += down.second[k] * across.second[i] *
                 (light_[receiver][cell] - static_cast<double>(slopes_.size()) * wanted_[receiver][cell]);
        }
      places.emplace_back(sum, index_at(x, y, cells.x));
    }
  std::sort(places.begin(), places.end());
  std::vector<glm::dvec2> best;
  for (const auto& place : places) best.push_back(layout_.middle_of_cell(place.second) + layout_.offset(receiver));
  return best;
}

Conflicts ConflictSearch::picture_conflicts() const {
  const std::size_t count = light_.size();
  const std::vector<double> sent = light_sent_to_each(layout_, slopes_);
  Conflicts conflicts{std::vector<double>(count), std::vector<std::vector<double>>(count, std::vector<double>(count))};
  for (std::size_t i = 0; i < slopes_.size(); ++i)
    for (std::size_t j = 0; j < count; ++j)
      conflicts.misplaced[j] += misplaced(i, j) * facet_power(layout_, i, slopes_[i], j) / sent[j];
  if (count == 1) return conflicts;

  const std::vector<std::size_t> facets = some_facets(layout_, 32);
  std::vector<std::vector<glm::dvec2>> best;
  for (std::size_t j = 0; j < count; ++j) best.push_back(best_places(j));
  std::vector<std::vector<std::vector<double>>> parts(facets.size(), conflicts.between); // all 0 yet
  for_ranges(facets.size(), 16, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const auto slope_to = [&](const glm::dvec2& to) {
          return slope_towards(layout_, facets[i],
                               (to - layout_.middle(facets[i])) / (layout_.distances[j] + heights_[facets[i]]), j);
        };
        const auto can = [&](const glm::dvec2& to) {
          return reachable(slope_to(to), layout_.n, layout_.sines_on(facets[i]), layout_.steepest);
        };
        const auto to = std::find_if(best[j].begin(), best[j].end(), can);
        if (to == best[j].end()) continue;
        const glm::dvec2 wish = slope_to(*to);
        if (change(facets[i], wish, j) >= 0) continue;
        double all = 0;
        for (std::size_t k = 0; k < count; ++k)
          if (k != j) all += parts[i][j][k] = std::max(0.0, change(facets[i], wish, k));
        const double light = misplaced(facets[i], j) * facet_power(layout_, facets[i], slopes_[facets[i]], j);
        for (double& loss : parts[i][j]) loss *= all > 0 ? light / all : 0;
      }
  });
  std::vector<double> some_sent(count);
  for (std::size_t j = 0; j < count; ++j)
    for (const std::size_t facet : facets) some_sent[j] += facet_power(layout_, facet, slopes_[facet], j);
  for (const auto& part : parts)
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < count; ++k) conflicts.between[j][k] += part[j][k] / some_sent[j];
  return conflicts;
}

} // namespace nephroid::inverse
