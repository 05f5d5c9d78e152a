// SPDX-License-Identifier: Apache-2.0
// Pictures of a difference: a value a pixel, and the colours that show it with their scale beside them.
#pragma once
#include "measure/metrics.h"

#include <array>

namespace nephroid::measure {

enum class DifferenceMetric {
  lab,       ///< distance in CIELAB
  absolute,  ///< |a - b|, mean of the channels
  relative,  ///< |a - b| / (|b| + .01), mean of the channels
  square,    ///< (a - b)^2, mean of the channels
  luminance, ///< signed: Y of a minus Y of b
  flip       ///< LDR FLIP's map, 0..1
};

/// What the command line calls them, in the order of the enumeration.
inline constexpr std::array<const char*, 6> difference_names{"lab",    "absolute",  "relative",
                                                             "square", "luminance", "flip"};

/// A value a pixel, at most the largest float. Throws as compare does.
std::vector<float> difference_map(const Pixels& picture, const Pixels& reference, DifferenceMetric metric);
/// Where the colours end: 1, 2 or 5 times a power of ten that 99 % of the values do not exceed; at least 1e-6.
double colour_scale(std::span<const float> values);
/// A colour of the map, sRGB-encoded, 8 bits a channel: position 0..1, magma from black to light yellow; signed maps
/// from blue over white at 0.5, no difference, to red. Positions outside are clipped, NaN is 0.
std::array<unsigned char, 3> map_colour(double position, bool is_signed = false);
bool is_signed(DifferenceMetric metric);

// The scale beside a difference picture, with seven-segment digits: it needs no font. Windows have their own.

/// A picture to draw on, opaque dark grey at first.
struct Bitmap {
  int width, height;
  std::vector<unsigned char> rgba;

  Bitmap(int w, int h);
  void set(int x, int y, const std::array<unsigned char, 3>& colour);
  std::array<unsigned char, 3> at(int x, int y) const;
  void fill(int x, int y, int w, int h, const std::array<unsigned char, 3>& colour);
};

struct ColourBar {
  int width, height; ///< with its margins and numbers
  int unit;          ///< the width of a stroke of a digit, in pixels
  int numbers;       ///< along the bar, both ends included
  double scale;      ///< the value at its top; 0 at its bottom, or minus this
  bool is_signed;
};

/// The bar for a picture of this height; it is higher where the picture is too low for two numbers.
ColourBar colour_bar(int picture_height, double scale, bool is_signed);
/// Draws it from the top, with its left edge at column x.
void draw(Bitmap& bitmap, int x, const ColourBar& bar);

/// Digits, '.', '-' and 'E', 5 x 9 units each and 2 apart; other characters are left out.
void draw_number(Bitmap& bitmap, int x, int y, int unit, std::string_view text);

struct ColouredDifference {
  int width = 0, height = 0;       ///< the map with the colour scale and its numbers drawn at its right
  std::vector<unsigned char> rgba; ///< 4 a pixel, opaque
  double scale = 1;                ///< the value at the end of the colours
};
/// The map in the left top corner. `scale` is the value at the end of the colours; 0: colour_scale of the values.
ColouredDifference coloured_difference(const Pixels& picture, const Pixels& reference, DifferenceMetric metric,
                                       double scale = 0);

} // namespace nephroid::measure
