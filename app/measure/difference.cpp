// SPDX-License-Identifier: Apache-2.0
#include "measure/difference.h"

#include "base/parallel.h"
#include "measure/flip.h"
#include "measure/lab.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nephroid::measure {
namespace {

constexpr std::size_t map_block_pixels = 8192;

double lab_distance(const float* a, const float* b) {
  const std::array<double, 3> la = lab_of(a), lb = lab_of(b);
  return std::hypot(la[0] - lb[0], la[1] - lb[1], la[2] - lb[2]);
}

/// The mean over the channels of what `of` makes of a and b.
template <class Of>
double channel_mean(const float* a, const float* b, const Of& of) {
  return (of(double{a[0]}, double{b[0]}) + of(double{a[1]}, double{b[1]}) + of(double{a[2]}, double{b[2]})) / 3;
}

double value(const float* a, const float* b, DifferenceMetric metric) {
  switch (metric) {
  case DifferenceMetric::lab: return lab_distance(a, b);
  case DifferenceMetric::absolute: return channel_mean(a, b, [](double x, double y) { return std::fabs(x - y); });
  case DifferenceMetric::relative:
    return channel_mean(a, b, [](double x, double y) { return std::fabs(x - y) / (std::fabs(y) + 0.01); });
  case DifferenceMetric::square: return channel_mean(a, b, [](double x, double y) { return (x - y) * (x - y); });
  case DifferenceMetric::luminance: return luminance(a) - luminance(b);
  case DifferenceMetric::flip: break; // flip_map: a pixel alone does not tell
  }
  return 0;
}

/// ColorBrewer's RdBu of 11 classes, red, green and blue of each, from blue to red (Cynthia Brewer, colorbrewer2.org).
constexpr int blue_to_red[] = {5,   48,  97,  33,  102, 172, 67,  147, 195, 146, 197, 222, 209, 229, 240, 247, 247,
                               247, 253, 219, 199, 244, 165, 130, 214, 96,  77,  178, 24,  43,  103, 0,   31};

std::array<float, 3> diverging(double position) {
  constexpr std::size_t last = std::size(blue_to_red) / 3 - 1;
  const double entry = position * last;
  const auto below = std::min(static_cast<std::size_t>(entry), last - 1);
  const double share = entry - static_cast<double>(below);
  std::array<float, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const int *const low = blue_to_red + 3 * below, *const high = low + 3;
    colour[c] = static_cast<float>(std::lerp(static_cast<double>(low[c]), high[c], share) / 255);
  }
  return colour;
}

using Colour = std::array<unsigned char, 3>;
constexpr Colour ground{32, 32, 32}, ink{224, 224, 224};

// Lengths in strokes of a digit.
constexpr int digit_width = 5, digit_height = 9, digit_step = digit_width + 2, point_step = 3;
constexpr int bar_margin = 6, bar_width = 14, gap = 4, longest_number = 7; ///< "-2.5E-7"

/// Segments a to g as bits 0 to 6: top, right above, right below, bottom, left below, left above, middle.
int segments(char character) {
  constexpr std::array<int, 10> digits{0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};
  if (character >= '0' && character <= '9') return digits[static_cast<std::size_t>(character - '0')];
  return character == 'E' ? 0x79 : character == '-' ? 0x40 : 0;
}

/// Four digits at most, exponents as short as they can be: 0.05, 12.5, 1E-6.
std::string number_text(double value) {
  std::string text = fmt::format("{:.4G}", value == 0 ? 0.0 : value);
  const std::size_t exponent = text.find('E');
  if (exponent == std::string::npos) return text;
  const std::string sign = text[exponent + 1] == '-' ? "-" : "";
  const std::size_t first = text.find_first_not_of('0', exponent + 2);
  return text.substr(0, exponent + 1) + sign + text.substr(first);
}

} // namespace

Bitmap::Bitmap(int w, int h)
    : width(w), height(h), rgba(std::size_t{4} * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 255) {
  fill(0, 0, w, h, ground);
}

void Bitmap::set(int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  const std::size_t at =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  std::copy(colour.begin(), colour.end(), rgba.begin() + static_cast<std::ptrdiff_t>(at));
}

Colour Bitmap::at(int x, int y) const {
  const std::size_t at =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return {rgba[at], rgba[at + 1], rgba[at + 2]};
}

void Bitmap::fill(int x, int y, int w, int h, const Colour& colour) {
  for (int row = y; row < y + h; ++row)
    for (int column = x; column < x + w; ++column) set(column, row, colour);
}

void draw_number(Bitmap& bitmap, int x, int y, int unit, std::string_view text) {
  struct Stroke {
    int x, y, w, h;
  };
  constexpr int half = digit_height / 2;
  constexpr std::array<Stroke, 7> strokes{{{0, 0, digit_width, 1},
                                           {digit_width - 1, 0, 1, half + 1},
                                           {digit_width - 1, half, 1, half + 1},
                                           {0, digit_height - 1, digit_width, 1},
                                           {0, half, 1, half + 1},
                                           {0, 0, 1, half + 1},
                                           {0, half, digit_width, 1}}};
  for (const char character : text) {
    if (character == '.') {
      bitmap.fill(x, y + (digit_height - 1) * unit, unit, unit, ink);
      x += point_step * unit;
      continue;
    }
    const int on = segments(character);
    if (on == 0) continue;
    for (std::size_t s = 0; s < strokes.size(); ++s)
      if (on >> s & 1)
        bitmap.fill(x + strokes[s].x * unit, y + strokes[s].y * unit, strokes[s].w * unit, strokes[s].h * unit, ink);
    x += digit_step * unit;
  }
}

ColourBar colour_bar(int picture_height, double scale, bool is_signed) {
  ColourBar bar{};
  bar.unit = std::max(1, picture_height / 400);
  bar.height = std::max(picture_height, 4 * digit_height * bar.unit);
  bar.numbers = bar.height > 12 * digit_height * bar.unit ? 5 : is_signed ? 3 : 2;
  bar.width = (2 * bar_margin + bar_width + gap + longest_number * digit_step) * bar.unit;
  bar.scale = scale;
  bar.is_signed = is_signed;
  return bar;
}

void draw(Bitmap& bitmap, int x, const ColourBar& bar) {
  const int top = bar_margin * bar.unit, length = bar.height - 2 * top;
  const int left = x + bar_margin * bar.unit, right = left + bar_width * bar.unit;
  for (int y = 0; y < length; ++y)
    bitmap.fill(left, top + y, bar_width * bar.unit, 1, map_colour(1 - (y + 0.5) / length, bar.is_signed));
  for (int i = 0; i < bar.numbers; ++i) {
    const double share = static_cast<double>(i) / (bar.numbers - 1);
    const int middle = top + static_cast<int>(std::lround((1 - share) * (length - bar.unit)));
    // No stroke leads from the bar to the number: it would read as minus.
    draw_number(bitmap, right + gap * bar.unit, middle - digit_height / 2 * bar.unit, bar.unit,
                number_text(bar.scale * (bar.is_signed ? 2 * share - 1 : share)));
  }
}

std::vector<float> difference_map(const Pixels& picture, const Pixels& reference, DifferenceMetric metric) {
  check_same_size(picture, reference.width, reference.height, reference.name);
  check_pixels(picture);
  check_pixels(reference);
  if (metric == DifferenceMetric::flip) return flip_map(picture, reference);
  constexpr double largest = std::numeric_limits<float>::max();
  std::vector<float> map(picture.rgb.size() / 3);
  for_ranges(map.size(), map_block_pixels, [&](std::size_t, Range range) {
    for (std::size_t p = range.begin; p < range.end; ++p)
      map[p] =
          static_cast<float>(std::clamp(value(&picture.rgb[3 * p], &reference.rgb[3 * p], metric), -largest, largest));
  });
  return map;
}

double colour_scale(std::span<const float> values) {
  constexpr double least = 1e-6;
  std::vector<float> sizes(values.size());
  std::transform(values.begin(), values.end(), sizes.begin(), [](float v) { return std::fabs(v); });
  if (sizes.empty()) return least;
  const std::size_t rank = (99 * sizes.size() + 99) / 100 - 1; // the 99th where there are 100
  const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sizes.begin(), nth, sizes.end());
  for (int power = -6;; ++power) // floats end at 3.4e38, so this ends
    for (const double digit : {1.0, 2.0, 5.0})
      if (const double scale = digit * std::pow(10.0, power); scale >= *nth) return scale;
}

std::array<unsigned char, 3> map_colour(double position, bool is_signed) {
  const double clipped = position > 0 ? std::min(position, 1.0) : 0; // and NaN is 0
  const std::array<float, 3> colour = is_signed ? diverging(clipped) : magma(clipped);
  std::array<unsigned char, 3> bytes{};
  std::transform(colour.begin(), colour.end(), bytes.begin(),
                 [](float c) { return static_cast<unsigned char>(std::lround(255 * c)); });
  return bytes;
}

bool is_signed(DifferenceMetric metric) { return metric == DifferenceMetric::luminance; }

ColouredDifference coloured_difference(const Pixels& picture, const Pixels& reference, DifferenceMetric metric,
                                       double scale) {
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
      const auto pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
      const double share = map[pixel] / scale;
      drawn.set(x, y, map_colour(both_ways ? (1 + share) / 2 : share, both_ways));
    }
  draw(drawn, picture.width, bar);
  result.rgba = std::move(drawn.rgba);
  return result;
}

} // namespace nephroid::measure
