// SPDX-License-Identifier: Apache-2.0
// A rising curve from floats to bytes, by tables instead of the curve itself: the window does this for every channel of every snapshot.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::ui {

/// exact: from a float of 0..end to its byte; rises, by one byte at most within 0.4 % of a value. What lies above the end is shown as 255,
/// what is not above 0 as exact(0).
template <unsigned char (*exact)(float)>
class ByteTable {
public:
  explicit ByteTable(float end) : end_(end), bytes_((bits(end) >> left_out_bits) + 1)
  {
    for (std::uint32_t i = 0; i < bytes_.size(); ++i) bytes_[i] = exact(std::bit_cast<float>(i << left_out_bits));
    for (std::uint32_t byte = 0; byte < 256; ++byte) least_[byte] = least_shown_as(byte);
    least_[256] = std::numeric_limits<float>::infinity();
  }

  unsigned char operator()(float value) const
  {
    value = std::min(std::max(0.0f, value), end_); // NaN: 0
    const unsigned char byte = bytes_[bits(value) >> left_out_bits];
    return static_cast<unsigned char>(byte + (value >= least_[byte + 1u])); // no branch: neighbours in a noisy picture are not alike
  }

private:
  /// Positive floats sort like their bits. Without the last of them they are steps of 0.4 % at most, in which one byte ends at most: those
  /// of sRGB are 0.9 % apart.
  static constexpr int left_out_bits = 15;

  static std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

  /// By bisection: the first float of 0..end that is shown as this byte or a greater one; the end, where there is none.
  float least_shown_as(std::uint32_t byte) const
  {
    std::uint32_t low = 0, high = bits(end_);
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (exact(std::bit_cast<float>(middle)) >= byte)
        high = middle;
      else
        low = middle + 1;
    }
    return std::bit_cast<float>(low);
  }

  float end_;
  std::vector<unsigned char> bytes_; ///< of each step's first float
  std::array<float, 257> least_{};   ///< [byte]: the first float that is shown as it
};

} // namespace nephroid::ui
