// SPDX-License-Identifier: Apache-2.0
// Picture files that image/image.h does not write: their bytes, of one grey all over.
#pragma once
#include "tests/support/test.h"

namespace nephroid::test {

template <class Value>
void append(std::string& bytes, const Value& value) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

/// An uncompressed EXR of 16-bit channels B, G, R ("OpenEXR File Layout"). half: the bits of the grey; 0x3c00 is 1.
inline std::string half_exr(int width, int height, std::uint16_t half) {
  std::string bytes("\x76\x2f\x31\x01\x02\0\0\0", 8), channels;
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    bytes += std::string(name) + '\0' + type + '\0';
    append(bytes, static_cast<std::int32_t>(value.size()));
    bytes += value;
  };
  for (const char* name : {"B", "G", "R"}) {
    channels += std::string(name) + '\0';
    for (const std::int32_t number : {1, 0, 1, 1}) append(channels, number); // half, not linear, every column and row
  }
  std::string box, one, two_zeros(8, '\0');
  for (const std::int32_t number : {0, 0, width - 1, height - 1}) append(box, number);
  append(one, 1.0f);
  attribute("channels", "chlist", channels + '\0');
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", box);
  attribute("displayWindow", "box2i", box);
  attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  attribute("pixelAspectRatio", "float", one);
  attribute("screenWindowCenter", "v2f", two_zeros);
  attribute("screenWindowWidth", "float", one);
  bytes += '\0';
  const std::int32_t row_bytes = 3 * 2 * width;
  const std::uint64_t rows_at = bytes.size() + 8 * static_cast<std::uint64_t>(height);
  for (int y = 0; y < height; ++y)
    append(bytes, rows_at + static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(row_bytes + 8));
  for (std::int32_t y = 0; y < height; ++y) {
    append(bytes, y);
    append(bytes, row_bytes);
    for (int value = 0; value < 3 * width; ++value) append(bytes, half);
  }
  return bytes;
}

/// A Radiance picture of the grey 1, without run lengths.
inline std::string radiance_hdr(int width, int height) {
  std::string bytes =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int i = 0; i < width * height; ++i) bytes += "\x80\x80\x80\x81"; // 128 / 256 2^(129 - 128)
  return bytes;
}

} // namespace nephroid::test
