// SPDX-License-Identifier: Apache-2.0
#include "ui/view/shown_pixels.h"

#include "image/image.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nephroid::ui {
namespace {

/// image::shown is a rising staircase of 256 steps: `step[b]` is the smallest value that is shown as b or brighter. Positive
/// floats sort like their bits, so each step is found by bisection over bit patterns, and `first` gives the byte to start from
/// for every upper half of a bit pattern (8 exponent and 7 mantissa bits: seldom more than one step lies inside).
struct Staircase {
  std::array<float, 257> step{};
  std::array<unsigned char, 1 << 15> first{};

  Staircase()
  {
    for (int byte = 1; byte < 256; ++byte) {
      std::uint32_t below = 0, at = std::bit_cast<std::uint32_t>(2.0f);
      while (at - below > 1) {
        const std::uint32_t middle = below + (at - below) / 2;
        (image::shown(std::bit_cast<float>(middle), 1.0f) >= byte ? at : below) = middle;
      }
      step[byte] = std::bit_cast<float>(at);
    }
    step[256] = std::numeric_limits<float>::infinity();
    unsigned byte = 0;
    for (std::uint32_t key = 0; key < first.size(); ++key) {
      const float value = std::bit_cast<float>(key << 16);
      while (byte < 255 && value >= step[byte + 1]) ++byte;
      first[key] = static_cast<unsigned char>(byte);
    }
  }

  unsigned char operator()(float value) const
  {
    if (!(value > 0)) return 0;
    unsigned char byte = first[std::bit_cast<std::uint32_t>(value) >> 16];
    while (byte < 255 && value >= step[byte + 1]) ++byte;
    return byte;
  }
};

const Staircase& staircase()
{
  static const Staircase made;
  return made;
}

} // namespace

unsigned char shown_byte(float linear, float exposure_scale) { return staircase()(linear * exposure_scale); }

void shown_pixels(std::span<const float> rgb, double exposure_stops, std::span<unsigned char> rgba8)
{
  const Staircase& byte_of = staircase();
  const float scale = static_cast<float>(std::exp2(exposure_stops));
  const std::size_t pixels = rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba8[4 * i + c] = byte_of(rgb[3 * i + c] * scale);
    rgba8[4 * i + 3] = 255;
  }
}

} // namespace nephroid::ui
