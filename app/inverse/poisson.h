// SPDX-License-Identifier: Apache-2.0
// Poisson's equation on a grid of nodes, with no flow over its rim.
#pragma once
#include <Eigen/Core>
#include <glm/glm.hpp>

namespace nephroid::inverse {

/// A value for each node or cell; a row of the grid is a row of the matrix.
using Grid = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Minus the Laplacian is the sum over neighbours of (u - u_neighbour) / spacing^2. Cosines are its eigenvectors
/// (Strang 1999, "The Discrete Cosine Transform", DCT-2), so solving is a transform and its inverse along either axis.
class Poisson {
public:
  Poisson(int columns, int rows, const glm::dvec2& spacing);
  /// Returns u with -Laplacian(u) = f - mean(f); the mean of u is 0.
  Grid solve(const Grid& f) const;

private:
  Grid one_over_value_; ///< [across][down]; 0 for the constant
};

} // namespace nephroid::inverse
