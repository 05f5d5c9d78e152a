// SPDX-License-Identifier: Apache-2.0
#include "image/rgb.h"

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace nephroid::image {
namespace {

/// Where R, G and B are among the channels; all three at Y where the picture is grey.
struct Layout {
  std::array<std::size_t, 3> at{};
  bool grey = false;
};

Layout layout_of(const Image& picture, const std::string& name)
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

} // namespace

Rgb rgb_of(const Image& picture, const std::string& name)
{
  const Layout layout = layout_of(picture, name);
  const std::size_t stride = picture.channels.size(), pixels = picture.data.size() / stride;
  Rgb rgb{std::vector<float>(3 * pixels), layout.grey};
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < 3; ++c) rgb.values[3 * p + c] = picture.data[p * stride + layout.at[c]];
  return rgb;
}

} // namespace nephroid::image
