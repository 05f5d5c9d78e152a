// SPDX-License-Identifier: Apache-2.0
// EXR files with the windows, parts and attributes that the program itself never writes: uncompressed floats.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::test {

/// From the first pixel to the last, as EXR has it.
using ExrWindow = std::array<std::int32_t, 4>;

struct ExrPart {
  ExrWindow data{}, display{};
  std::vector<std::string> channels; ///< in the order of the alphabet
  std::vector<float> values;         ///< of the data window, pixel after pixel from its top
  int tile = 0;                      ///< side of a tile, or 0 for rows
  std::vector<std::pair<std::string, std::vector<float>>> attributes{}; ///< chromaticities, or a single number
  std::string name{}, type = "scanlineimage";                           ///< of one of several parts
};

namespace exr_detail {

template <class T>
std::string raw(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + raw(static_cast<std::int32_t>(value.size())) + value;
}

inline std::string header(const ExrPart& part, std::size_t chunks, bool several) {
  std::string channels;
  for (const std::string& name : part.channels)
    channels += name + '\0' + raw(std::int32_t{2}) + raw(std::int32_t{0}) + raw(std::int32_t{1}) + raw(std::int32_t{1});
  std::string text =
      attribute("channels", "chlist", channels + '\0') + attribute("compression", "compression", std::string(1, '\0')) +
      attribute("dataWindow", "box2i", raw(part.data)) + attribute("displayWindow", "box2i", raw(part.display)) +
      attribute("lineOrder", "lineOrder", std::string(1, '\0')) + attribute("pixelAspectRatio", "float", raw(1.0f)) +
      attribute("screenWindowCenter", "v2f", raw(std::array<float, 2>{})) +
      attribute("screenWindowWidth", "float", raw(1.0f));
  for (const auto& [name, numbers] : part.attributes) {
    std::string value;
    for (const float number : numbers) value += raw(number);
    text += attribute(name, numbers.size() == 1 ? "float" : name, value);
  }
  if (part.tile > 0)
    text += attribute("tiles", "tiledesc",
                      raw(std::int32_t{part.tile}) + raw(std::int32_t{part.tile}) + std::string(1, '\0'));
  if (part.type.starts_with("deep")) text += attribute("version", "int", raw(std::int32_t{1}));
  if (several)
    text += attribute("name", "string", part.name) + attribute("type", "string", part.type) +
            attribute("chunkCount", "int", raw(static_cast<std::int32_t>(chunks)));
  return text + '\0';
}

/// Rows, or tiles, each with the place that it stands for.
inline std::vector<std::string> chunks(const ExrPart& part) {
  const int width = part.data[2] - part.data[0] + 1, height = part.data[3] - part.data[1] + 1;
  const int across = part.tile > 0 ? part.tile : width, down = part.tile > 0 ? part.tile : 1;
  std::vector<std::string> all;
  for (int top = 0; top < height; top += down)
    for (int left = 0; left < width; left += across) {
      std::string pixels;
      for (int y = top; y < std::min(height, top + down); ++y)
        for (std::size_t c = 0; c < part.channels.size(); ++c)
          for (int x = left; x < std::min(width, left + across); ++x)
            pixels += raw(part.values.at(static_cast<std::size_t>(y * width + x) * part.channels.size() + c));
      const std::string place = part.tile > 0 ? raw(std::int32_t{left / across}) + raw(std::int32_t{top / down}) +
                                                    raw(std::int32_t{0}) + raw(std::int32_t{0})
                                              : raw(std::int32_t{part.data[1] + top});
      all.push_back(place + raw(static_cast<std::int32_t>(pixels.size())) + pixels);
    }
  return all;
}

} // namespace exr_detail

inline std::string exr(const std::vector<ExrPart>& parts) {
  using exr_detail::raw;
  const bool several = parts.size() > 1 || parts[0].type.starts_with("deep");
  const std::uint32_t flags = (several ? 0x1000u : 0) | (!several && parts[0].tile > 0 ? 0x200u : 0) |
                              (parts[0].type.starts_with("deep") ? 0x800u : 0);
  std::string text = "v/1\x01" + raw(2u | flags);
  std::vector<std::string> chunks;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::vector<std::string> own = exr_detail::chunks(parts[p]);
    text += exr_detail::header(parts[p], own.size(), several);
    for (const std::string& chunk : own) chunks.push_back(several ? raw(static_cast<std::int32_t>(p)) + chunk : chunk);
  }
  if (several) text += '\0';
  std::uint64_t at = text.size() + chunks.size() * sizeof at;
  for (const std::string& chunk : chunks) {
    text += raw(at);
    at += chunk.size();
  }
  for (const std::string& chunk : chunks) text += chunk;
  return text;
}

} // namespace nephroid::test
