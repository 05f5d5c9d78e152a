// SPDX-License-Identifier: Apache-2.0
#include "photons/mixture.h"

#include "base/parallel.h"
#include "base/summed_area.h"

#include <algorithm>
#include <cmath>

namespace nephroid::photons {
namespace {

/// The radii around a pixel, in pixels, of the means of its errors and of its light.
constexpr int error_radius = 8, light_radius = 7;

} // namespace

double least_light(std::span<const double> light) {
  double sum = 0, count = 0;
  for (const double pixel_light : light)
    if (pixel_light > 0) sum += pixel_light, ++count;
  return count > 0 ? 0.01 * sum / count : 1;
}

void mix(std::span<const float> picture, std::span<const float> picture_draw, const Estimate& estimate,
         std::span<const double> light, int width, int height, std::vector<float>& rgb,
         std::vector<float>& error_draw) {
  const auto draw_of = [&](std::size_t c) { return estimate.error_draw.empty() ? 0.0 : estimate.error_draw[c]; };
  const double dark = least_light(light);
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  // Sums term(c, r) of the three channels c of a pixel, divided by the light there.
  const auto relative_to_light = [&](std::size_t i, const auto& term) {
    double sum = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) sum += term(c, static_cast<double>(estimate.rgb[c]) - rgb[c]);
    return sum / (dark + lights.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, light_radius));
  };
  const SummedArea slopes(width, height, [&](std::size_t i) {
    return relative_to_light(i, [&](std::size_t c, double r) {
      return r * (static_cast<double>(rgb[c]) - picture[c]) + (draw_of(c) - error_draw[c]) * picture_draw[c];
    });
  });
  // A draw of the noise in r (b - p).
  const SummedArea scatters(width, height, [&](std::size_t i) {
    return std::pow(relative_to_light(i,
                                      [&](std::size_t c, double r) {
                                        return r * (static_cast<double>(error_draw[c]) - picture_draw[c]) +
                                               (draw_of(c) - error_draw[c]) *
                                                   (static_cast<double>(rgb[c]) - picture[c]);
                                      }),
                    2);
  });
  const SummedArea squares(
      width, height, [&](std::size_t i) { return relative_to_light(i, [](std::size_t, double r) { return r * r; }); });
  for_ranges(light.size(), std::size_t{1} << 12, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      const double scatter = std::sqrt(std::max(scatters.sum(x, y, error_radius), 0.0));
      const double gain = -slopes.sum(x, y, error_radius) - scatter, square = squares.sum(x, y, error_radius);
      if (gain <= 0 || square <= 0) continue;
      const auto weight = static_cast<float>(std::min(gain / square, 1.0));
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
        rgb[c] += weight * (estimate.rgb[c] - rgb[c]);
        error_draw[c] += weight * (static_cast<float>(draw_of(c)) - error_draw[c]);
      }
    }
  });
}

} // namespace nephroid::photons
