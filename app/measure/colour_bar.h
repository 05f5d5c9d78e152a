// SPDX-License-Identifier: Apache-2.0
// The scale beside a difference picture: the colours from bottom to top, with numbers in seven-segment digits, so that a picture needs
// no font. Not for windows, which have text.
#pragma once
#include <array>
#include <string_view>
#include <vector>

namespace nephroid::measure {

/// A picture to draw on, opaque dark grey at first.
struct Bitmap {
  int width, height;
  std::vector<unsigned char> rgba;

  Bitmap(int w, int h);
  void set(int x, int y, const std::array<unsigned char, 3>& colour);
  void fill(int x, int y, int w, int h, const std::array<unsigned char, 3>& colour);
};

struct ColourBar {
  int width, height; ///< with its margins and numbers
  int unit;          ///< the width of a stroke of a digit, in pixels
  int numbers;       ///< along the bar, both ends included
  double scale;      ///< the value at its top; 0 at its bottom, or minus this
  bool is_signed;
};

/// For a picture of this height; the bar is higher where the picture is too low for two numbers.
ColourBar colour_bar(int picture_height, double scale, bool is_signed);
/// With its left edge at column x, from the top.
void draw(Bitmap& bitmap, int x, const ColourBar& bar);

/// Digits, '.', '-' and 'E', 5 x 9 units each and 2 apart; other characters are left out.
void draw_number(Bitmap& bitmap, int x, int y, int unit, std::string_view text);

} // namespace nephroid::measure
