// SPDX-License-Identifier: Apache-2.0
#include "measure/colour_bar.h"

#include "measure/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace nephroid::measure {
namespace {

using Colour = std::array<unsigned char, 3>;
constexpr Colour ground{32, 32, 32}, ink{224, 224, 224};

// All in units of a stroke.
constexpr int digit_width = 5, digit_height = 9, digit_step = digit_width + 2, point_step = 3;
constexpr int bar_margin = 6, bar_width = 14, gap = 4, longest_number = 7; ///< "-2.5E-7"

/// Segments a to g as bits 0 to 6: top, right above, right below, bottom, left below, left above, middle.
int segments(char character)
{
  constexpr std::array<int, 10> digits{0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};
  if (character >= '0' && character <= '9') return digits[static_cast<std::size_t>(character - '0')];
  return character == 'E' ? 0x79 : character == '-' ? 0x40 : 0;
}

/// Three digits at most, exponents as short as they can be: 0.05, 12.5, 1E-6.
std::string number_text(double value)
{
  std::string text = fmt::format("{:.3G}", value == 0 ? 0.0 : value);
  const std::size_t exponent = text.find('E');
  if (exponent == std::string::npos) return text;
  const std::string sign = text[exponent + 1] == '-' ? "-" : "";
  const std::size_t first = text.find_first_not_of('0', exponent + 2);
  return text.substr(0, exponent + 1) + sign + text.substr(first);
}

} // namespace

Bitmap::Bitmap(int w, int h) : width(w), height(h), rgba(std::size_t{4} * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 255)
{
  fill(0, 0, w, h, ground);
}

void Bitmap::set(int x, int y, const Colour& colour)
{
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  std::copy(colour.begin(), colour.end(), rgba.begin() + static_cast<std::ptrdiff_t>(at));
}

void Bitmap::fill(int x, int y, int w, int h, const Colour& colour)
{
  for (int row = y; row < y + h; ++row)
    for (int column = x; column < x + w; ++column) set(column, row, colour);
}

void draw_number(Bitmap& bitmap, int x, int y, int unit, std::string_view text)
{
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
      if (on >> s & 1) bitmap.fill(x + strokes[s].x * unit, y + strokes[s].y * unit, strokes[s].w * unit, strokes[s].h * unit, ink);
    x += digit_step * unit;
  }
}

ColourBar colour_bar(int picture_height, double scale, bool is_signed)
{
  ColourBar bar{};
  bar.unit = std::max(1, picture_height / 400);
  bar.height = std::max(picture_height, 4 * digit_height * bar.unit);
  bar.numbers = bar.height > 12 * digit_height * bar.unit ? 5 : is_signed ? 3 : 2;
  bar.width = (2 * bar_margin + bar_width + gap + longest_number * digit_step) * bar.unit;
  bar.scale = scale;
  bar.is_signed = is_signed;
  return bar;
}

void draw(Bitmap& bitmap, int x, const ColourBar& bar)
{
  const int top = bar_margin * bar.unit, length = bar.height - 2 * top;
  const int left = x + bar_margin * bar.unit, right = left + bar_width * bar.unit;
  for (int y = 0; y < length; ++y) bitmap.fill(left, top + y, bar_width * bar.unit, 1, map_colour(1 - (y + 0.5) / length, bar.is_signed));
  for (int i = 0; i < bar.numbers; ++i) {
    const double share = static_cast<double>(i) / (bar.numbers - 1);
    const int middle =
        top + static_cast<int>(std::lround((1 - share) * (length - bar.unit))); // of the number: no stroke, it reads as minus
    draw_number(bitmap, right + gap * bar.unit, middle - digit_height / 2 * bar.unit, bar.unit,
                number_text(bar.scale * (bar.is_signed ? 2 * share - 1 : share)));
  }
}

} // namespace nephroid::measure
