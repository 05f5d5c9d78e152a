// SPDX-License-Identifier: Apache-2.0
// Scores every slope that a facet can have: how much it would bring the light towards the pictures.
#pragma once
#include "inverse/layout.h"

#include <cstdint>
#include <span>

namespace nephroid::inverse {

/// Over one receiver: weight * 2 (Z - T) a cell, with a rim of zeros around that is as wide as a beam.
struct Lack {
  int rim = 0, width = 0; ///< cells; width: of a row, both rims included
  std::vector<float> values;
};

/// Of the lacks of all receivers: where facets are much larger than cells, or blur is, the rims are wider than the receivers.
std::uint64_t lack_bytes(const Layout& layout);

/// Of each picture's squares: the layout's weights, so that pictures of one weight count alike. Their cost is of light over its maximum,
/// and a mean over the cells with light in them.
std::vector<double> picture_weights(const Layout& layout, const std::vector<Target>& targets);

/// Sum over receivers and cells of weight * (Z - T)^2, of as much wanted light as there are facets: what is lowered. light:
/// [receiver][cell], in facets that send all of theirs.
double weighted_squares(const std::vector<Target>& targets, std::span<const double> weights, const std::vector<std::vector<double>>& light,
                        std::size_t facets);

class SlopeSearch {
public:
  /// weights: of a receiver's squares; heights: of the facets' middles. The layout and the heights outlive it.
  SlopeSearch(const Layout& layout, std::span<const double> weights, const std::vector<double>& heights);

  /// Other weights, as many.
  void weigh(std::span<const double> weights) { weights_.assign(weights.begin(), weights.end()); }

  /// Slopes lead to a lattice of points on the last receiver, one a cell where that has no more than 64 a side, moved by `offset` (0..1 of
  /// their distance).
  void aim(const glm::dvec2& offset) { offset_ = offset; }

  /// Of every receiver. light: [receiver][cell], in facets that send all of theirs.
  std::vector<Lack> lacks(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light) const;

  /// The slope with the lowest sum over receivers and cells of lack * a + weight * a^2, a being the facet's light there, of equals the
  /// first; a is that of a facet as large as if it lay flat. Empty: the facet can reach no point of the lattice.
  /// All three take off n . pull, n being the facet's normal: see cost.h.
  std::optional<glm::dvec2> best(std::size_t facet, std::span<const Lack> lacks, const glm::dvec3& pull = glm::dvec3(0)) const;

  /// The same sum for one slope, of the facet's true footprint and power.
  double score(std::size_t facet, const glm::dvec2& slope, std::span<const Lack> lacks, const glm::dvec3& pull = glm::dvec3(0)) const;

  /// A slope near `from` that scores no worse: steps to four sides, from half the lattice's to an eighth of a cell, as long as they gain.
  glm::dvec2 refined(std::size_t facet, glm::dvec2 from, std::span<const Lack> lacks, const glm::dvec3& pull = glm::dvec3(0)) const;

private:
  struct Columns;
  Columns columns(std::size_t receiver, double from, double height, int axis) const;
  void add_scores(std::size_t receiver, std::size_t facet, const Lack& lack, std::vector<float>& scores) const;
  double point(int i, int axis) const;

  const Layout& layout_;
  std::vector<double> weights_;
  const std::vector<double>& heights_;
  glm::ivec2 lattice_;
  glm::dvec2 offset_{0.5, 0.5};
};

} // namespace nephroid::inverse
