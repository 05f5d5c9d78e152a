// SPDX-License-Identifier: Apache-2.0
#include "ui/state/shown_pixels.h"

#include "image/image.h"
#include "ui/state/byte_table.h"

#include <cmath>
#include <cstddef>

namespace nephroid::ui {
namespace {

unsigned char exact(float value) { return image::shown(value, 1); }

const ByteTable<exact>& table()
{
  static const ByteTable<exact> bytes(1);
  return bytes;
}

} // namespace

unsigned char shown_byte(float linear, float exposure_scale) { return table()(linear * exposure_scale); }

void shown_pixels(std::span<const float> rgb, double exposure_stops, std::span<unsigned char> rgba8)
{
  const ByteTable<exact>& bytes = table();
  const float scale = static_cast<float>(std::exp2(exposure_stops));
  const std::size_t pixels = rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba8[4 * i + c] = bytes(rgb[3 * i + c] * scale);
    rgba8[4 * i + 3] = 255;
  }
}

} // namespace nephroid::ui
