// SPDX-License-Identifier: Apache-2.0
// A rising curve from floats to bytes, by a table instead of the curve itself: the window does this for every channel of every snapshot.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

namespace nephroid::ui {

/// exact: from a float of 0..end to its byte; rises. What lies above the end is shown as 255, what is not above 0 as exact(0).
template <unsigned char (*exact)(float)>
class ByteTable {
public:
  explicit ByteTable(float end) : end_(end), bytes_((std::bit_cast<std::uint32_t>(end) >> left_out_bits) + 2)
  {
    for (std::uint32_t i = 0; i < bytes_.size(); ++i) bytes_[i] = exact(std::bit_cast<float>(i << left_out_bits));
  }

  unsigned char operator()(float value) const
  {
    if (!(value > 0)) return bytes_[0];
    if (value >= end_) return 255;
    const std::uint32_t i = std::bit_cast<std::uint32_t>(value) >> left_out_bits;
    return bytes_[i] == bytes_[i + 1] ? bytes_[i] : exact(value);
  }

private:
  /// Positive floats sort like their bits: where two floats whose last bits are 0 are shown alike, so is what lies between, which is nearly
  /// everywhere.
  static constexpr int left_out_bits = 12;

  float end_;
  std::vector<unsigned char> bytes_;
};

} // namespace nephroid::ui
