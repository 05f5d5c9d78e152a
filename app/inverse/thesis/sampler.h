// SPDX-License-Identifier: Apache-2.0
// The joint probability of a facet's slope (thesis 5.1), and draws from it.
#pragma once
#include "inverse/layout.h"
#include "inverse/thesis/thesis_settings.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <random>
#include <vector>

namespace nephroid::inverse {

/// What light is aimed at over one distance.
struct Aim {
  double distance = 100;
  std::vector<double> picture; ///< of each cell, at most 1: a probability up to a factor that all have
  double beside = 0;           ///< the same of light that misses the receiver: h of (5.4)
};

struct Draws {
  std::vector<glm::dvec2> slopes;
  std::vector<int> cells; ///< [draw][aim]; -1: beside the receiver
};

/// A slope's probability is the product of what all pictures have where the facet's middle sends light with it. Slopes are those of a
/// lattice over all that lead to a receiver and that the index can bend by; one that misses all receivers has probability 0.
class Sampler {
public:
  Sampler(const Layout& layout, const std::vector<Aim>& aims, const Thesis& settings);

  /// So many independent slopes; none where every slope's product is 0.
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
  std::vector<std::vector<double>> padded_; ///< pictures with a rim of one cell that has `beside`; all light beside counts as in cell 0
  std::vector<std::vector<char>> lit_columns_, lit_rows_; ///< of these: whether any cell is above 0
  int directions_;
  Thesis::Sampling sampling_;
};

} // namespace nephroid::inverse
