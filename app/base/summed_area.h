// SPDX-License-Identifier: Apache-2.0
// Sums of one channel of a picture over any square, from four numbers each (Crow 1984, "Summed-area tables for texture
// mapping").
#pragma once
#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephroid {

class SummedArea {
public:
  /// value(pixel): the pixel's value in the channel; pixels go row by row from the top. It is called on every core.
  template <class Value>
  SummedArea(int width, int height, const Value& value) : width_(width), height_(height) {
    const std::size_t stride = static_cast<std::size_t>(width) + 1;
    sums_.assign(stride * (static_cast<std::size_t>(height) + 1), 0.0);
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    constexpr std::size_t rows_of_a_block = 32, columns_of_a_block = 64;
    for_ranges(rows, rows_of_a_block, [&](std::size_t, Range block) {
      for (std::size_t y = block.begin; y < block.end; ++y) {
        double sum = 0;
        for (std::size_t x = 0; x < columns; ++x) sums_[(y + 1) * stride + x + 1] = sum += value(y * columns + x);
      }
    });
    for_ranges(columns, columns_of_a_block, [&](std::size_t, Range block) {
      for (std::size_t y = 1; y < rows; ++y)
        for (std::size_t x = block.begin + 1; x <= block.end; ++x) sums_[(y + 1) * stride + x] += sums_[y * stride + x];
    });
  }

  /// The sum over the square that reaches `reach` pixels to each side of (x, y), cut to the picture.
  double sum(int x, int y, int reach) const {
    const int left = std::max(x - reach, 0), right = std::min(x + reach + 1, width_);
    const int top = std::max(y - reach, 0), bottom = std::min(y + reach + 1, height_);
    return at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
  }

  /// The number of sum()'s pixels, and the mean over them.
  double count(int x, int y, int reach) const {
    const int columns = std::min(x + reach + 1, width_) - std::max(x - reach, 0),
              rows = std::min(y + reach + 1, height_) - std::max(y - reach, 0);
    return static_cast<double>(columns) * rows;
  }
  double mean(int x, int y, int reach) const { return sum(x, y, reach) / count(x, y, reach); }

private:
  /// The sum of all pixels left of x and above y.
  double at(int x, int y) const {
    return sums_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(x)];
  }
  int width_, height_;
  std::vector<double> sums_;
};

} // namespace nephroid
