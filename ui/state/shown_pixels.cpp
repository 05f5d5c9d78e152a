// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/shown_pixels.h"

#include "image/image.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::ui {
namespace {

constexpr int left_out_bits = 12;

/// What image::shown makes of every float of 0..1 whose last bits are 0. It rises, and positive floats sort like their bits: where two
/// neighbours are shown alike, so is what lies between, which is nearly everywhere.
const std::vector<unsigned char>& table()
{
  static const std::vector<unsigned char> made = [] {
    std::vector<unsigned char> bytes((std::bit_cast<std::uint32_t>(1.0f) >> left_out_bits) + 1);
    for (std::uint32_t i = 0; i < bytes.size(); ++i) bytes[i] = image::shown(std::bit_cast<float>(i << left_out_bits), 1);
    return bytes;
  }();
  return made;
}

unsigned char byte_of(const std::vector<unsigned char>& bytes, float value)
{
  if (!(value > 0)) return 0;
  if (value >= 1) return 255;
  const std::uint32_t i = std::bit_cast<std::uint32_t>(value) >> left_out_bits;
  return bytes[i] == bytes[i + 1] ? bytes[i] : image::shown(value, 1);
}

} // namespace

unsigned char shown_byte(float linear, float exposure_scale) { return byte_of(table(), linear * exposure_scale); }

void shown_pixels(std::span<const float> rgb, double exposure_stops, std::span<unsigned char> rgba8)
{
  const std::vector<unsigned char>& bytes = table();
  const float scale = static_cast<float>(std::exp2(exposure_stops));
  const std::size_t pixels = rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba8[4 * i + c] = byte_of(bytes, rgb[3 * i + c] * scale);
    rgba8[4 * i + 3] = 255;
  }
}

} // namespace nephroid::ui
