// SPDX-License-Identifier: Apache-2.0
// A grey picture of pixels: a file, or words.
#pragma once
#include "base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::inverse {

struct Grey {
  int width = 0, height = 0;
  std::vector<double> values; ///< 0..1, row 0 at the top

  double at(int x, int y) const
  {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Luminance of linear sRGB over its maximum. Throws bad_input naming the file where it cannot be read, has a value that is no light, or
/// is one grey all over.
Grey read_grey(const std::filesystem::path& file);

/// Words, as wide and as high as they are. where: for messages. Throws bad_input where they cannot be drawn.
Grey grey_of_words(const std::string& words, const Place& where);

} // namespace nephroid::inverse
