// SPDX-License-Identifier: Apache-2.0
// Means around pixels, each of pixels of its own kind: noise in glass and along outlines is no noise of what is beside.
#pragma once
#include "base/parallel.h"
#include "base/summed_area.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::photons {

class KindsOfPixels {
public:
  /// All pixels are of one kind.
  KindsOfPixels(int width, int height) : width_(width), height_(height) {}
  /// is_other(pixel): whether it is of the second kind. It is called on every core.
  template <class IsOther>
  KindsOfPixels(int width, int height, const IsOther& is_other)
      : width_(width), height_(height), is_other_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    for_items(is_other_.size(), [&](std::size_t i) { is_other_[i] = is_other(i); });
    others_.emplace(width, height, [&](std::size_t i) { return is_other_[i]; });
  }

  /// Of a value of each pixel.
  class Sums {
  public:
    /// The mean over the pixel's kind in the square that reaches `reach` pixels to each side of it.
    double mean(std::size_t pixel, int reach) const {
      const KindsOfPixels& kinds = *kinds_;
      const int x = static_cast<int>(pixel) % kinds.width_, y = static_cast<int>(pixel) / kinds.width_;
      if (!kinds.others_) return of_kind_[0].mean(x, y, reach);
      const double others = kinds.others_->sum(x, y, reach);
      return kinds.is_other_[pixel] != 0 ? of_kind_[1].sum(x, y, reach) / others
                                         : of_kind_[0].sum(x, y, reach) / (of_kind_[0].count(x, y, reach) - others);
    }

  private:
    friend class KindsOfPixels;
    const KindsOfPixels* kinds_ = nullptr;
    std::vector<SummedArea> of_kind_;
  };

  /// value(pixel) is called on every core. The kinds outlive the sums.
  template <class Value>
  Sums sums(const Value& value) const {
    Sums sums;
    sums.kinds_ = this;
    for (int kind = 0; kind < (others_ ? 2 : 1); ++kind)
      sums.of_kind_.emplace_back(width_, height_, [&](std::size_t i) {
        return !others_ || is_other_[i] == kind ? static_cast<double>(value(i)) : 0.0;
      });
    return sums;
  }

private:
  int width_, height_;
  std::vector<std::uint8_t> is_other_; ///< [pixel]; empty with one kind
  std::optional<SummedArea> others_;   ///< how many pixels are of the second kind
};

} // namespace nephroid::photons
