// SPDX-License-Identifier: Apache-2.0
// Poisson's equation on a grid of nodes, with no flow over its rim.
#pragma once
#include <Eigen/Core>
#include <glm/glm.hpp>

namespace nephroid::inverse {

/// A value a node or a cell; a row of the grid is a row here.
using Grid = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Minus the Laplacian is sum over neighbours of (u - u_neighbour) / spacing^2. Cosines are its eigenvectors (Strang
/// 1999, "The Discrete Cosine Transform", DCT-2), so that solving is a transform there and back along either axis.
class Poisson {
public:
  Poisson(int columns, int rows, const glm::dvec2& spacing);
  /// u with -Laplacian(u) = f less f's mean; the mean of u is 0.
  Grid solve(const Grid& f) const;

private:
  Grid one_over_value_; ///< [across][down]; 0 for the constant
};

} // namespace nephroid::inverse
