// SPDX-License-Identifier: Apache-2.0
#include "measure/metrics.h"

#include "base/error.h"
#include "base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace nephroid::measure {
namespace {

/// The first value that is NaN or infinite, or rgb.size().
std::size_t first_not_finite(std::span<const float> rgb)
{
  std::atomic<std::size_t> first = rgb.size();
  for_ranges(rgb.size(), std::size_t{1} << 16, [&](std::size_t, Range range) {
    // A product with 0 is 0 or NaN: a sum of them tells whether all are finite, several at a time.
    float zeros = 0;
    for (std::size_t i = range.begin; i < range.end; ++i) zeros += rgb[i] * 0.0f;
    if (zeros == 0) return;
    const auto* const found = std::find_if_not(rgb.data() + range.begin, rgb.data() + range.end, [](float v) { return std::isfinite(v); });
    const auto index = static_cast<std::size_t>(found - rgb.data());
    for (std::size_t known = first; index < known && !first.compare_exchange_weak(known, index);) {
    }
  });
  return first;
}

std::string value_name(float value) { return std::isnan(value) ? "NaN" : value > 0 ? "infinity" : "-infinity"; }

} // namespace

void check_pixels(const Pixels& picture)
{
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != 3 * pixels)
    throw failed(picture.name, fmt::format("a picture of {} x {} has {} values", picture.width, picture.height, picture.rgb.size()));
  const std::size_t at = first_not_finite(picture.rgb);
  if (at == picture.rgb.size()) return;
  const std::size_t column = at / 3 % static_cast<std::size_t>(picture.width), row = at / 3 / static_cast<std::size_t>(picture.width);
  throw bad_input(picture.name, fmt::format("pixel ({}, {}) has {} in {}", column, row, value_name(picture.rgb[at]), "RGB"[at % 3]),
                  "expected finite values everywhere");
}

void check_same_size(const Pixels& picture, int width, int height, const std::string& reference_name)
{
  if (picture.width == width && picture.height == height) return;
  throw bad_input(picture.name, fmt::format("is {} x {} pixels", picture.width, picture.height),
                  fmt::format("expected {} x {}, the size of {}", width, height, reference_name));
}

void check_mask(Mask mask, int width, int height, const std::string& name)
{
  if (mask.empty()) return;
  if (mask.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw bad_input(name, fmt::format("has {} pixels", mask.size()), fmt::format("expected {} x {}, as the pictures", width, height));
  if (std::all_of(mask.begin(), mask.end(), [](unsigned char m) { return m == 0; }))
    throw bad_input(name, "is all black: no pixel counts", "expected a mask with pixels that are not 0");
}

} // namespace nephroid::measure
