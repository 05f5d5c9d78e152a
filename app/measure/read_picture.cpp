// SPDX-License-Identifier: Apache-2.0
#include "measure/read_picture.h"

#include "base/error.h"
#include "image/image.h"
#include "measure/parallel.h"
#include "measure/pixels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nephroid::measure {
namespace {

/// Where R, G and B are among the channels; all three at Y where the picture is grey.
struct Layout {
  std::array<std::size_t, 3> at{};
  bool grey = false;
};

Layout layout_of(const image::Image& picture, const std::string& name)
{
  const auto& channels = picture.channels;
  const auto index = [&](const char* channel) {
    return static_cast<std::size_t>(std::find(channels.begin(), channels.end(), channel) - channels.begin());
  };
  const Layout colour{{index("R"), index("G"), index("B")}, false};
  if (std::all_of(colour.at.begin(), colour.at.end(), [&](std::size_t i) { return i < channels.size(); })) return colour;
  const std::size_t y = index("Y");
  if (y < channels.size() && std::all_of(channels.begin(), channels.end(), [](const std::string& c) { return c == "Y" || c == "A"; }))
    return {{y, y, y}, true};
  throw bad_input(name, fmt::format("has the channels {}", fmt::join(channels, ", ")), "expected R, G, B or Y alone");
}

/// The three channels of every pixel, as the file has them.
std::vector<float> picked(const image::Image& picture, const Layout& layout)
{
  const std::size_t stride = picture.channels.size(), pixels = picture.data.size() / stride;
  std::vector<float> rgb(3 * pixels);
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * p + c] = picture.data[p * stride + layout.at[c]];
  return rgb;
}

void decode(std::vector<float>& rgb)
{
  for_ranges(rgb.size(), std::size_t{1} << 15, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) rgb[i] = static_cast<float>(image::decoded_srgb(rgb[i]));
  });
}

} // namespace

LinearPicture read_linear_rgb(const std::filesystem::path& file)
{
  image::Image picture = image::read_image(file);
  const Layout layout = layout_of(picture, file.string());
  std::vector<float> rgb = picked(picture, layout);
  if (picture.integers) decode(rgb);
  return {picture.width, picture.height, std::move(rgb), file.string(), layout.grey, std::move(picture.attributes)};
}

std::vector<unsigned char> read_mask(const std::filesystem::path& file, int width, int height)
{
  const image::Image picture = image::read_image(file);
  const std::vector<float> rgb = picked(picture, layout_of(picture, file.string()));
  const Pixels pixels{picture.width, picture.height, rgb, file.string()};
  check_same_size(pixels, width, height, "the pictures");
  check_pixels(pixels);
  std::vector<unsigned char> mask(rgb.size() / 3);
  for (std::size_t p = 0; p < mask.size(); ++p) mask[p] = rgb[3 * p] != 0 || rgb[3 * p + 1] != 0 || rgb[3 * p + 2] != 0;
  check_mask(mask, width, height, file.string());
  return mask;
}

} // namespace nephroid::measure
