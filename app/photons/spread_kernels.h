// SPDX-License-Identifier: Apache-2.0
// The kernels of smoothing.h: how far the light of each pixel goes, and to which of the pixels around it.
//
// A few pixels in a row do the same at once in vector registers: they go through all pixels within reach in one order,
// each looking at the one that stands there from it.
#pragma once
#include "base/parallel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nephroid::photons {

/// Values of the pixels of a picture, with zeros before and after them, so that reads past either end find 0.
class Plane {
public:
  Plane() = default;
  Plane(std::size_t pixels, std::size_t margin);
  /// value(pixel) is called on every core.
  template <class Value>
  Plane(std::size_t pixels, std::size_t margin, const Value& value) : Plane(pixels, margin) {
    for_items(pixels, [&](std::size_t i) { (*this)[i] = static_cast<float>(value(i)); });
  }
  float& operator[](std::size_t pixel) { return values_[margin_ + pixel]; }
  float operator[](std::size_t pixel) const { return values_[margin_ + pixel]; }
  const float* at(std::ptrdiff_t pixel) const { return values_.data() + static_cast<std::ptrdiff_t>(margin_) + pixel; }

private:
  std::size_t margin_ = 0;
  std::vector<float> values_;
};

/// Where each pixel's light goes. Of what it gives, a pixel takes a part in proportion to its favour. The outermost
/// ring takes less, so that a kernel grows without a jump.
struct SpreadKernels {
  Plane inside, end;          ///< [pixel], whole numbers: pixels before the outermost ring, and with it
  Plane ring_weight;          ///< [pixel], 0..1: of a pixel of that ring
  Plane scale, ring_scale;    ///< [pixel]: factors of a pixel inside and of that ring; all that is given is then 1
  std::vector<float> largest; ///< the largest `end` of each 16 pixels in a row
};

/// Which pixels the light of a pixel may be spread over.
class SpreadDomain {
public:
  SpreadDomain() = default;
  /// may_give(i, j) for two pixels within reach is the same as may_give(j, i). It is called on every core.
  SpreadDomain(int width, int height, const std::function<bool(std::size_t, std::size_t)>& may_give);
  static std::uint64_t bytes_per_pixel();

  template <class Value>
  Plane plane(const Value& value) const {
    return Plane(pixels_, margin_, value);
  }

  /// Each kernel holds `wanted` (0 or more) of the light or reaches as far as any may, and has no scale yet.
  SpreadKernels kernels_of(const Plane& light, const Plane& wanted) const;
  /// favour: above 0.
  void scale(SpreadKernels& kernels, const Plane& favour) const;
  /// What the kernels bring each pixel of the given values, without its favour as a factor. channels: 1 or 3.
  template <std::size_t channels>
  std::array<Plane, channels> collect(const SpreadKernels& kernels, const std::array<Plane, channels>& given) const;

private:
  int width_ = 0;
  std::size_t pixels_ = 0, margin_ = 0;
  std::vector<std::uint32_t> may_give_; ///< [word][pixel]: a bit for each pixel within reach, nearest first

  Plane zeros() const { return Plane(pixels_, margin_); }
  /// The words of all pixels, for each word.
  std::vector<const std::uint32_t*> words_of_pixels() const;
};

} // namespace nephroid::photons
