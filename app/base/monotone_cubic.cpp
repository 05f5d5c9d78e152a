// SPDX-License-Identifier: Apache-2.0
#include "base/monotone_cubic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephroid {

MonotoneCubic::MonotoneCubic(std::vector<Row> sorted) : rows_(std::move(sorted)), slopes_(rows_.size(), 0.0) {
  const std::size_t count = rows_.size();
  if (count < 2) return;
  std::vector<double> secants(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i)
    secants[i] = (rows_[i + 1][1] - rows_[i][1]) / (rows_[i + 1][0] - rows_[i][0]);

  slopes_.front() = secants.front();
  slopes_.back() = secants.back();
  for (std::size_t i = 1; i + 1 < count; ++i)
    slopes_[i] = secants[i - 1] * secants[i] > 0 ? (secants[i - 1] + secants[i]) / 2 : 0;

  // Monotone where (slope / secant) of both ends lies in the disc of radius 3: scale the pair back onto it.
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (secants[i] == 0) {
      slopes_[i] = slopes_[i + 1] = 0;
      continue;
    }
    const double alpha = slopes_[i] / secants[i], beta = slopes_[i + 1] / secants[i];
    const double length = std::hypot(alpha, beta);
    if (length <= 3) continue;
    slopes_[i] = 3 / length * alpha * secants[i];
    slopes_[i + 1] = 3 / length * beta * secants[i];
  }
}

double MonotoneCubic::operator()(double x) const {
  if (x <= rows_.front()[0]) return rows_.front()[1];
  if (x >= rows_.back()[0]) return rows_.back()[1];
  const auto above =
      std::upper_bound(rows_.begin(), rows_.end(), x, [](double at, const Row& row) { return at < row[0]; });
  const auto i = static_cast<std::size_t>(above - rows_.begin()) - 1;
  const Row &a = rows_[i], &b = rows_[i + 1];
  const double width = b[0] - a[0], t = (x - a[0]) / width, t2 = t * t, t3 = t2 * t;
  const double value = (2 * t3 - 3 * t2 + 1) * a[1] + (t3 - 2 * t2 + t) * width * slopes_[i] +
                       (3 * t2 - 2 * t3) * b[1] + (t3 - t2) * width * slopes_[i + 1];
  // In exact arithmetic this changes nothing; it keeps rounding from stepping over a control point.
  return std::clamp(value, std::min(a[1], b[1]), std::max(a[1], b[1]));
}

} // namespace nephroid
