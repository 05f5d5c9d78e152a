// SPDX-License-Identifier: Apache-2.0
#include "inverse/pictures/grey.h"

#include "image/image.h"

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {

Grey read_grey(const std::filesystem::path& file)
{
  const image::Image picture = image::read_image(file);
  const image::Rgb rgb = image::rgb_of(picture, file.string());
  const auto alpha = std::find(picture.channels.begin(), picture.channels.end(), "A");
  const bool transparent = alpha != picture.channels.end() && picture.integers; // colours of floats are multiplied by it already
  const auto opacity = [&](std::size_t pixel) {
    return transparent ? picture.data[pixel * picture.channels.size() + static_cast<std::size_t>(alpha - picture.channels.begin())] : 1.0f;
  };
  Grey grey{picture.width, picture.height, {}};
  for (std::size_t i = 0; i < rgb.values.size(); i += 3) {
    const auto linear = [&](std::size_t channel) {
      const double value = rgb.values[i + channel];
      return picture.integers ? image::decoded_srgb(value) : value;
    };
    const double y = (0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2)) * opacity(i / 3);
    if (!std::isfinite(y) || y < 0)
      throw bad_input(file.string(), "has a pixel that is negative or not a number", "expected a picture of light");
    grey.values.push_back(y);
  }
  const auto [low, high] = std::minmax_element(grey.values.begin(), grey.values.end());
  if (*high == 0) throw bad_input(file.string(), "is black all over", "expected a picture with some light in it");
  if (*low == *high)
    throw bad_input(file.string(), "is one grey all over", "expected a picture with an outline", "for a disc of light use a drawing");
  const double most = *high;
  for (double& value : grey.values) value /= most;
  return grey;
}

Grey grey_of_words(const std::string& words, const Place& where)
{
  constexpr int height = 256; // finer than any cell, so that the cells' mean is that of the letters
  const image::Image drawn = image::text_picture(words, height, where);
  return {drawn.width, drawn.height, {drawn.data.begin(), drawn.data.end()}};
}

} // namespace nephroid::inverse
