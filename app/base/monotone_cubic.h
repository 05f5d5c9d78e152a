// SPDX-License-Identifier: Apache-2.0
// A smooth curve through control points that never overshoots them.
#pragma once
#include <array>
#include <vector>

namespace nephroid {

/// The monotone piecewise cubic of Fritsch and Carlson (SIAM J. Numer. Anal. 17, 1980). Its slope is continuous, and
/// between two control points it stays between their values. Outside, the end values are held.
class MonotoneCubic {
public:
  using Row = std::array<double, 2>; ///< x and y of a control point

  /// At least one control point, by rising x, each x once.
  explicit MonotoneCubic(std::vector<Row> sorted);
  double operator()(double x) const;

private:
  std::vector<Row> rows_;
  std::vector<double> slopes_; ///< one slope per control point
};

} // namespace nephroid
