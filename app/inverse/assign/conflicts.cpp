// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/conflicts.h"

#include "base/parallel.h"
#include "inverse/assign/footprint.h"
#include "inverse/assign/slope_search.h"
#include "inverse/assign/squares.h"

#include <algorithm>
#include <utility>

namespace nephroid::inverse {

ConflictSearch::ConflictSearch(const Layout& layout, const std::vector<Target>& targets, const std::vector<glm::dvec2>& slopes,
                               const std::vector<double>& heights, const std::vector<std::vector<double>>& light)
    : layout_(layout), targets_(targets), slopes_(slopes), heights_(heights), light_(light), weights_(picture_weights(layout, targets)),
      too_much_(light)
{
  const double sent = light_sent(layout, slopes);
  for (std::size_t j = 0; j < light.size(); ++j)
    for (std::size_t c = 0; c < light[j].size(); ++c)
      too_much_[j][c] = light[j][c] > 0 ? std::max(0.0, 1 - sent * targets[j][c] / light[j][c]) : 0;
}

/// Part of the facet's light.
double ConflictSearch::misplaced(std::size_t facet, std::size_t receiver) const
{
  double well = 0;
  for_cells(layout_, footprint(layout_, facet, slopes_[facet], receiver, heights_[facet]),
            [&](std::size_t cell, double part) { well += part * (1 - too_much_[receiver][cell]); });
  return 1 - well;
}

std::vector<double> ConflictSearch::of_facets() const
{
  std::vector<double> most(slopes_.size());
  for_ranges(most.size(), 256, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t j = 0; j < light_.size(); ++j) most[i] = std::max(most[i], misplaced(i, j));
  });
  return most;
}

/// What a picture's weighted squares would change by with the facet at another slope.
double ConflictSearch::change(std::size_t facet, const glm::dvec2& slope, std::size_t receiver) const
{
  std::vector<std::pair<std::size_t, double>> moves; // a cell, and how much it gets
  const auto move = [&](const glm::dvec2& to, double sign) {
    const double power = sign * facet_power(layout_, facet, to);
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
    sum += gets * (2 * (light_[receiver][cell] - static_cast<double>(slopes_.size()) * targets_[receiver][cell]) + gets);
  return weights_[receiver] * sum;
}

Conflicts ConflictSearch::of_pictures() const
{
  const std::size_t count = light_.size();
  const double sent = light_sent(layout_, slopes_);
  Conflicts conflicts{std::vector<double>(count), std::vector<std::vector<double>>(count, std::vector<double>(count))};
  for (std::size_t i = 0; i < slopes_.size(); ++i)
    for (std::size_t j = 0; j < count; ++j) conflicts.misplaced[j] += misplaced(i, j) * facet_power(layout_, i, slopes_[i]) / sent;
  if (count == 1) return conflicts;

  const std::vector<std::size_t> facets = some_facets(layout_, 32);
  std::vector<SlopeSearch> alone; // with that picture only
  std::vector<std::vector<Lack>> lacks;
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<double> own(count);
    own[j] = weights_[j];
    alone.emplace_back(layout_, own, heights_);
    lacks.push_back(alone[j].lacks(targets_, light_));
  }
  std::vector<std::vector<std::vector<double>>> parts(facets.size(), conflicts.between); // all 0 yet
  for_ranges(facets.size(), 16, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const std::optional<glm::dvec2> wish = alone[j].best(facets[i], lacks[j]);
        if (!wish || change(facets[i], *wish, j) >= 0) continue;
        double all = 0;
        for (std::size_t k = 0; k < count; ++k)
          if (k != j) all += parts[i][j][k] = std::max(0.0, change(facets[i], *wish, k));
        const double light = misplaced(facets[i], j) * facet_power(layout_, facets[i], slopes_[facets[i]]);
        for (double& loss : parts[i][j]) loss *= all > 0 ? light / all : 0;
      }
  });
  double some_sent = 0;
  for (const std::size_t facet : facets) some_sent += facet_power(layout_, facet, slopes_[facet]);
  for (const auto& part : parts)
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < count; ++k) conflicts.between[j][k] += part[j][k] / some_sent;
  return conflicts;
}

} // namespace nephroid::inverse
