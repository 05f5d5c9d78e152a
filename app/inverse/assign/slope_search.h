// SPDX-License-Identifier: Apache-2.0
// Scores every slope that one facet can have: how much it would bring the light towards the pictures. On the host, for a few facets.
#pragma once
#include "inverse/layout.h"

#include <optional>
#include <span>
#include <vector>

namespace nephroid::inverse {

/// Over one receiver: weight * 2 (Z - T) a cell, with a rim of zeros around that is as wide as a beam.
struct Lack {
  int rim = 0, width = 0; ///< cells; width: of a row, both rims included
  std::vector<float> values;
};

/// Slopes lead to a lattice of points on the last receiver, one a cell where that has no more than 64 a side.
class SlopeSearch {
public:
  /// weights: of a receiver's squares; heights: of the facets' middles. The layout and the heights outlive it.
  SlopeSearch(const Layout& layout, std::span<const double> weights, const std::vector<double>& heights);

  /// Of every receiver. light: [receiver][cell], in facets that send all of theirs.
  std::vector<Lack> lacks(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light) const;

  /// The slope with the lowest sum over receivers and cells of lack * a + weight * a^2, a being the facet's light there, of equals the
  /// first; a is that of a facet as large as if it lay flat. Empty: the facet can reach no point of the lattice.
  std::optional<glm::dvec2> best(std::size_t facet, std::span<const Lack> lacks) const;

private:
  struct Columns;
  Columns columns(std::size_t receiver, double from, double height, int axis) const;
  void add_scores(std::size_t receiver, std::size_t facet, const Lack& lack, std::vector<float>& scores) const;
  double point(int i, int axis) const;

  const Layout& layout_;
  std::vector<double> weights_;
  const std::vector<double>& heights_;
  glm::ivec2 lattice_;
};

} // namespace nephroid::inverse
