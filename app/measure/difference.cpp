// SPDX-License-Identifier: Apache-2.0
#include "measure/difference.h"

#include "base/parallel.h"
#include "measure/colour_bar.h"
#include "measure/flip.h"
#include "measure/lab.h"
#include "measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nephroid::measure {
namespace {

constexpr std::size_t map_block_pixels = 8192;

double lab_distance(const float* a, const float* b)
{
  const std::array<double, 3> la = lab_of(a), lb = lab_of(b);
  return std::hypot(la[0] - lb[0], la[1] - lb[1], la[2] - lb[2]);
}

/// The mean over the channels of what `of` makes of a and b.
template <class Of>
double channel_mean(const float* a, const float* b, const Of& of)
{
  return (of(double{a[0]}, double{b[0]}) + of(double{a[1]}, double{b[1]}) + of(double{a[2]}, double{b[2]})) / 3;
}

double value(const float* a, const float* b, DifferenceMetric metric)
{
  switch (metric) {
  case DifferenceMetric::lab:
    return lab_distance(a, b);
  case DifferenceMetric::absolute:
    return channel_mean(a, b, [](double x, double y) { return std::fabs(x - y); });
  case DifferenceMetric::relative:
    return channel_mean(a, b, [](double x, double y) { return std::fabs(x - y) / (std::fabs(y) + 0.01); });
  case DifferenceMetric::square:
    return channel_mean(a, b, [](double x, double y) { return (x - y) * (x - y); });
  case DifferenceMetric::luminance:
    return luminance(a) - luminance(b);
  case DifferenceMetric::flip: // not of a pixel alone: flip_map
    break;
  }
  return 0;
}

/// ColorBrewer's RdBu of 11 classes, from blue to red (Cynthia Brewer, colorbrewer2.org).
constexpr std::array<std::array<int, 3>, 11> blue_to_red{{{5, 48, 97},
                                                          {33, 102, 172},
                                                          {67, 147, 195},
                                                          {146, 197, 222},
                                                          {209, 229, 240},
                                                          {247, 247, 247},
                                                          {253, 219, 199},
                                                          {244, 165, 130},
                                                          {214, 96, 77},
                                                          {178, 24, 43},
                                                          {103, 0, 31}}};

std::array<float, 3> diverging(double position)
{
  const double entry = position * (blue_to_red.size() - 1);
  const auto below = static_cast<std::size_t>(std::min(entry, static_cast<double>(blue_to_red.size() - 2)));
  const double share = entry - static_cast<double>(below);
  std::array<float, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<float>(std::lerp(static_cast<double>(blue_to_red[below][c]), blue_to_red[below + 1][c], share) / 255);
  return colour;
}

} // namespace

std::vector<float> difference_map(const Pixels& picture, const Pixels& reference, DifferenceMetric metric)
{
  check_same_size(picture, reference.width, reference.height, reference.name);
  check_pixels(picture);
  check_pixels(reference);
  if (metric == DifferenceMetric::flip) return flip_map(picture, reference);
  constexpr double largest = std::numeric_limits<float>::max();
  std::vector<float> map(picture.rgb.size() / 3);
  for_ranges(map.size(), map_block_pixels, [&](std::size_t, Range range) {
    for (std::size_t p = range.begin; p < range.end; ++p)
      map[p] = static_cast<float>(std::clamp(value(&picture.rgb[3 * p], &reference.rgb[3 * p], metric), -largest, largest));
  });
  return map;
}

double colour_scale(std::span<const float> values)
{
  constexpr double least = 1e-6;
  std::vector<float> sizes(values.size());
  std::transform(values.begin(), values.end(), sizes.begin(), [](float v) { return std::fabs(v); });
  if (sizes.empty()) return least;
  const std::size_t rank = (99 * sizes.size() + 99) / 100 - 1; // of 100 values the 99th
  const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sizes.begin(), nth, sizes.end());
  for (int power = -6;; ++power) // floats end at 3.4e38, so this ends
    for (const double digit : {1.0, 2.0, 5.0})
      if (const double scale = digit * std::pow(10.0, power); scale >= *nth) return scale;
}

std::array<unsigned char, 3> map_colour(double position, bool is_signed)
{
  const double clipped = position > 0 ? std::min(position, 1.0) : 0; // and NaN is 0
  const std::array<float, 3> colour = is_signed ? diverging(clipped) : magma(clipped);
  std::array<unsigned char, 3> bytes{};
  std::transform(colour.begin(), colour.end(), bytes.begin(), [](float c) { return static_cast<unsigned char>(std::lround(255 * c)); });
  return bytes;
}

bool is_signed(DifferenceMetric metric) { return metric == DifferenceMetric::luminance; }

ColouredDifference coloured_difference(const Pixels& picture, const Pixels& reference, DifferenceMetric metric, double scale)
{
  const std::vector<float> map = difference_map(picture, reference, metric);
  if (scale == 0) scale = colour_scale(map);
  const bool both_ways = is_signed(metric);
  const ColourBar bar = colour_bar(picture.height, scale, both_ways);
  ColouredDifference result;
  result.width = picture.width + bar.width;
  result.height = std::max(picture.height, bar.height);
  result.scale = scale;
  Bitmap drawn(result.width, result.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double share = map[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)] / scale;
      drawn.set(x, y, map_colour(both_ways ? (1 + share) / 2 : share, both_ways));
    }
  draw(drawn, picture.width, bar);
  result.rgba = std::move(drawn.rgba);
  return result;
}

} // namespace nephroid::measure
