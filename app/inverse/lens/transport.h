// SPDX-License-Identifier: Apache-2.0
// Where light has to go so that one picture becomes another on the shortest ways: optimal transport. Its map is the
// gradient of a potential, as a smooth surface bends light (Schwartzburg et al. 2014, caustic design).
#pragma once
#include "base/bytes.h"
#include "inverse/poisson.h"

#include <glm/glm.hpp>

namespace nephroid::inverse {

/// The back-and-forth method (Jacobs and Leger 2020, "A fast approach to optimal transport"). It steps along the
/// gradient of the dual problem, by turns in its two potentials, in the metric in which the gradient solves Poisson's
/// equation. Lengths are in parts of the grid's longer side. Both pictures are on one grid of square cells.
class Transport {
public:
  Transport(Grid from, Grid to);

  void advance(); ///< makes a step in either potential
  /// The part of the light that the map of the last step did not bring to its cell.
  double astray() const { return astray_; }
  /// Where the light at p goes. p and the result are in cells from the first cell's corner.
  glm::dvec2 map(const glm::dvec2& p) const;

  glm::dvec2 cells() const { return {from_.cols(), from_.rows()}; } ///< across and down

  void serialize(Archive& archive);

private:
  struct Side {
    Grid potential;
    double step = 1;
  };
  void move(Side& side, const Grid& wanted, const Grid& arrived, Side& other);
  double value() const; ///< the value of the dual problem

  Grid from_, to_; ///< densities over the domain whose area is the grid's
  double cell_;
  Poisson poisson_;
  // The state. psi is on the side of `from`.
  Side phi_, psi_;
  double astray_ = 1;
};

/// The light of quads whose corners land at these places, in cells of the result; each sample is spread over the four
/// cells about it. `corners` is row by row, one more either way than `light`. Light beside goes to the rim.
Grid spread(const Grid& light, const std::vector<glm::dvec2>& corners, Eigen::Index rows, Eigen::Index columns);

/// min over y of |x - y|^2 / 2 - f(y), over the middles of cells.
Grid conjugate(const Grid& f, double cell);

} // namespace nephroid::inverse
