// SPDX-License-Identifier: Apache-2.0
#include "measure/laplacian_pyramid.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace nephroid::measure {
namespace {

/// [1 4 6 4 1] / 16 times sqrt 2, along rows and along columns: a low pass doubles the values of a flat picture, and
/// the same filter brings a zero-stuffed level back to their scale.
constexpr double unit = std::numbers::sqrt2 / 16;
constexpr std::array<double, 5> binomial{1 * unit, 4 * unit, 6 * unit, 4 * unit, 1 * unit};

constexpr std::size_t pyramid_block_rows = 32;

/// Mirrored about the first and the last sample, which are not repeated; position is -2..n + 1 and n at least 2.
std::size_t reflected(std::ptrdiff_t position, std::size_t n) {
  const auto last = static_cast<std::ptrdiff_t>(n) - 1;
  if (position < 0) position = -position;
  if (position > last) position = 2 * last - position;
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(position, 0)); // n = 2 mirrors twice
}

/// fill(row, y): of the plane's rows, which are 0 at first.
template <class Fill>
Plane plane_of(std::size_t width, std::size_t height, const Fill& fill) {
  Plane plane(width, height);
  for_ranges(height, pyramid_block_rows, [&](std::size_t, Range rows) {
    for (std::size_t y = rows.begin; y < rows.end; ++y) fill(plane.row(y), y);
  });
  return plane;
}

Plane transposed(const Plane& plane) {
  return plane_of(plane.height, plane.width, [&](double* row, std::size_t y) {
    for (std::size_t x = 0; x < plane.height; ++x) row[x] = plane.row(x)[y];
  });
}

/// Filters along the columns and keeps every second row.
Plane rows_halved(const Plane& plane) {
  return plane_of(plane.width, (plane.height + 1) / 2, [&](double* row, std::size_t y) {
    for (std::size_t tap = 0; tap < 5; ++tap) {
      const double* const from = plane.row(reflected(static_cast<std::ptrdiff_t>(2 * y + tap) - 2, plane.height));
      for (std::size_t x = 0; x < plane.width; ++x) row[x] += binomial[tap] * from[x];
    }
  });
}

/// Puts a row of zeros after every row (but the last where height is odd) and filters along the columns.
Plane rows_doubled(const Plane& plane, std::size_t height) {
  return plane_of(plane.width, height, [&](double* row, std::size_t y) {
    for (std::size_t tap = 0; tap < 5; ++tap) {
      const std::size_t stuffed = reflected(static_cast<std::ptrdiff_t>(y + tap) - 2, height);
      if (stuffed % 2 != 0) continue;
      const double* const from = plane.row(stuffed / 2);
      for (std::size_t x = 0; x < plane.width; ++x) row[x] += binomial[tap] * from[x];
    }
  });
}

Plane low_pass(const Plane& plane) { return transposed(rows_halved(transposed(rows_halved(plane)))); }

void subtract_enlarged(Plane& plane, const Plane& low) {
  const Plane enlarged = transposed(rows_doubled(transposed(rows_doubled(low, plane.height)), plane.width));
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] -= enlarged.values[i];
}

/// Every second sample j of a line of n that was enlarged to 4 n - 3 and extended by one sample at either end.
struct EnlargedLine {
  std::size_t n;

  /// The enlarged line: its centres lie (k + 1/2) n / (4 n - 3) - 1/2 from the first pixel's; outside, the end goes on.
  template <class At>
  double between(std::size_t k, const At& at) const {
    const double length = static_cast<double>(4 * n - 3), last = static_cast<double>(n - 1);
    const double position =
        std::clamp((static_cast<double>(k) + 0.5) * static_cast<double>(n) / length - 0.5, 0.0, last);
    const std::size_t low = std::min(static_cast<std::size_t>(position), n - 2);
    const double share = position - static_cast<double>(low);
    return (1 - share) * at(low) + share * at(low + 1);
  }
  template <class At>
  double operator()(std::size_t j, const At& at) const {
    if (j == 0) return 2 * between(0, at) - between(1, at);
    if (j == 2 * n - 1) return 2 * between(4 * n - 4, at) - between(4 * n - 5, at);
    return between(2 * j - 1, at);
  }
};

Plane rows_enlarged(const Plane& plane, std::size_t height) {
  const EnlargedLine line{plane.height};
  return plane_of(plane.width, height, [&](double* row, std::size_t y) {
    for (std::size_t x = 0; x < plane.width; ++x) row[x] = line(y, [&](std::size_t i) { return plane.row(i)[x]; });
  });
}

} // namespace

std::vector<Plane> laplacian_pyramid(Plane picture, int levels) {
  std::vector<Plane> pyramid;
  for (int level = 1; level < levels; ++level) {
    Plane low = low_pass(picture);
    subtract_enlarged(picture, low);
    pyramid.push_back(std::exchange(picture, std::move(low)));
  }
  pyramid.push_back(std::move(picture));
  return pyramid;
}

Plane enlarged_parent(const Plane& parent, std::size_t width, std::size_t height) {
  return transposed(rows_enlarged(transposed(rows_enlarged(parent, height)), width));
}

} // namespace nephroid::measure
