// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/surface.h"

#include <algorithm>
#include <array>
#include <vector>

namespace nephroid::inverse {
namespace {

/// Replaces each row's values by the parts of bells that have them at the nodes: 1/6, 4/6 and 1/6 high there. At either
/// end the third difference of the parts is 0, which with the second node's equation leaves c0 - c1 = f0 - f1.
Grid parts_along_rows(const Grid& values) {
  const Eigen::Index count = values.cols();
  Grid parts(values.rows(), count + 2);
  auto inner = parts.middleCols(1, count);
  inner = values;
  if (count == 2) {
    parts.col(0) = 2 * values.col(0) - values.col(1);
    parts.col(3) = 2 * values.col(1) - values.col(0);
    return parts;
  }
  Eigen::VectorXd over(count); // the diagonal beside the pivot, once rows before are taken away
  inner.col(0) = values.col(0) - values.col(1);
  over[0] = -1;
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    const double pivot = 4 - over[i - 1];
    over[i] = 1 / pivot;
    inner.col(i) = (6 * values.col(i) - inner.col(i - 1)) / pivot;
  }
  const Eigen::Index last = count - 1;
  inner.col(last) = (values.col(last) - values.col(last - 1) + inner.col(last - 1)) / (1 + over[last - 1]);
  for (Eigen::Index i = last - 1; i >= 0; --i) inner.col(i) -= over[i] * inner.col(i + 1);
  parts.col(0) = 3 * inner.col(0) - 3 * inner.col(1) + inner.col(2);
  parts.col(count + 1) = 3 * inner.col(last) - 3 * inner.col(last - 1) + inner.col(last - 2);
  return parts;
}

/// Four bells at t of the way from one node to the next, with their derivatives.
struct BSplineBasis {
  std::array<double, 4> value, first, second;
};

BSplineBasis bells_at(double t) {
  const double u = 1 - t;
  return {{u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6, t * t * t / 6},
          {-u * u / 2, (3 * t - 4) * t / 2, (4 - 3 * u) * u / 2, t * t / 2},
          {u, 3 * t - 2, 3 * u - 2, t}};
}

} // namespace

Spline::Spline(const Grid& values) : parts_(parts_along_rows(parts_along_rows(values).transpose()).transpose()) {}

Spline::At Spline::at(const glm::dvec2& p) const {
  const auto piece = [](double at, Eigen::Index parts) {
    return std::clamp(static_cast<Eigen::Index>(at), Eigen::Index{0}, parts - 4);
  };
  const Eigen::Index x = piece(p.x, parts_.cols()), y = piece(p.y, parts_.rows());
  const BSplineBasis across = bells_at(p.x - static_cast<double>(x)), down = bells_at(p.y - static_cast<double>(y));
  At result;
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double* const row = &parts_(y + k, x);
    double value = 0, first = 0, second = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value += across.value[i] * row[i];
      first += across.first[i] * row[i];
      second += across.second[i] * row[i];
    }
    const auto j = static_cast<std::size_t>(k);
    result.value += down.value[j] * value;
    result.gradient += glm::dvec2(down.value[j] * first, down.first[j] * value);
    result.curvature += glm::dvec3(down.value[j] * second, down.first[j] * first, down.second[j] * value);
  }
  return result;
}

} // namespace nephroid::inverse
