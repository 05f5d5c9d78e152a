// SPDX-License-Identifier: Apache-2.0
// The joint probability of a facet's slope (thesis 5.1), draws from it, and what light aimed at some pictures makes of
// them by many draws of every facet (thesis 5.2, "cost computation").
#pragma once
#include "base/bytes.h"
#include "inverse/layout.h"

#include <random>

namespace nephroid::inverse {

/// What light is aimed at over one distance.
struct SamplingTarget {
  double distance = 100;
  std::vector<double> picture; ///< a value for each cell, at most 1: a probability up to a factor that all have
  double beside = 0;           ///< the value for light that misses the receiver: h of (5.4)
};

struct Draws {
  std::vector<glm::dvec2> slopes;
  std::vector<int> cells; ///< [draw][aim]; -1: beside the receiver
};

/// A slope's probability is the product of what all pictures have where the facet's middle sends such light. The slopes
/// are a lattice over all that lead to a receiver and that the index can bend by; those that miss all have probability
/// 0.
class Sampler {
public:
  Sampler(const Layout& layout, const std::vector<SamplingTarget>& aims, const Thesis& settings);

  /// `count` independent slopes; none where every slope's product is 0.
  Draws draw(std::size_t facet, int count, std::mt19937_64& random) const;

private:
  struct Axis;
  struct Lattice;
  Axis axis(std::size_t facet, int along) const;
  Lattice lattice(std::size_t facet) const;
  double product(const Lattice& lattice, std::size_t column, std::size_t row) const;
  void multiply_row(const Lattice& lattice, std::size_t row, std::vector<double>& products) const;

  const Layout& layout_;
  std::vector<double> distances_;
  std::vector<std::vector<double>> padded_; ///< pictures with a rim of `beside`; light beside counts as in cell 0
  std::vector<std::vector<char>> lit_columns_, lit_rows_; ///< whether any cell of a column or a row of these is above 0
  int directions_;
  Thesis::Sampling sampling_;
};

struct TrialResult {
  std::vector<std::vector<double>> light; ///< [receiver][cell]: mean of the draws, in facets
  std::vector<glm::dvec2> slopes;         ///< each facet's first draw; a facet without one has its flat slope
  std::uint64_t dark = 0;                 ///< facets whose joint probability is 0 everywhere: they send light nowhere
};

std::vector<glm::dvec2> flat_slopes(const Layout& layout);

class Trial {
public:
  /// layout and settings outlive it. The same aims and seed give the same draws, on any number of threads.
  Trial(const Layout& layout, const std::vector<SamplingTarget>& aims, const Thesis& settings, std::uint64_t seed);

  void advance(); ///< draws some facets
  bool finished() const { return next_ == layout_.facet_count(); }
  double fraction_done() const { return static_cast<double>(next_) / static_cast<double>(layout_.facet_count()); }
  std::size_t tried() const { return next_; } ///< completed facets
  TrialResult drawn() const;

  void serialize(Archive& archive); ///< is loaded only into a trial of the same aims

private:
  const Layout& layout_;
  const Thesis& settings_;
  std::uint64_t seed_;
  Sampler sampler_;
  // The state.
  std::size_t next_ = 0;
  std::vector<std::vector<std::uint32_t>> counts_; ///< [receiver][cell]
  std::vector<glm::dvec2> slopes_;
  std::uint64_t dark_ = 0;
};

} // namespace nephroid::inverse
