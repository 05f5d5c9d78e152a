// SPDX-License-Identifier: Apache-2.0
// Little-endian TIFF files, which say how a camera was held (Exif's orientation).
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::test {

/// One byte a pixel, row by row from the top; with alpha two, 1: associated, 2: not. profile: ICC's.
inline std::string tiff(int width, int height, int orientation, const std::string& pixels, int alpha = 0,
                        const std::string& profile = {}) {
  std::string bytes = "II";
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
  };
  const int samples = alpha == 0 ? 1 : 2;
  std::vector<std::pair<int, int>> tags{
      {256, width}, {257, height},      {258, 8 | 8 << 16}, {259, 1},      {262, 1},
      {273, 0},     {274, orientation}, {277, samples},     {278, height}, {279, width * height * samples}};
  if (alpha != 0) tags.emplace_back(338, alpha);
  if (!profile.empty()) tags.emplace_back(34675, static_cast<int>(profile.size()));
  const std::uint32_t strip = 8 + 2 + 12 * static_cast<std::uint32_t>(tags.size()) + 4;
  const std::uint32_t behind = strip + static_cast<std::uint32_t>(pixels.size());
  put(42, 2), put(8, 4), put(static_cast<std::uint32_t>(tags.size()), 2);
  for (const auto& [tag, value] : tags) {
    if (tag == 34675) {
      put(34675, 2), put(7, 2), put(static_cast<std::uint32_t>(value), 4), put(behind, 4);
      continue;
    }
    put(static_cast<std::uint32_t>(tag), 2), put(tag == 273 ? 4 : 3, 2), put(tag == 258 ? samples : 1, 4),
        put(tag == 273 ? strip : static_cast<std::uint32_t>(value), 4);
  }
  put(0, 4);
  return bytes + pixels + profile;
}

} // namespace nephroid::test
