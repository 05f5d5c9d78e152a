// SPDX-License-Identifier: Apache-2.0
// Bytes as text, for files inside text (RFC 4648).
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace nephroid {

inline std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      text += i + static_cast<std::size_t>(k) > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

/// The bytes, with or without padding at the text's end; nothing where it has other characters.
inline std::optional<std::string> from_base64(std::string_view text) {
  static constexpr unsigned char none = 64;
  static constexpr std::array<unsigned char, 256> values = [] {
    std::array<unsigned char, 256> all{};
    all.fill(none);
    unsigned char value = 0;
    for (const char digit : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      all[static_cast<unsigned char>(digit)] = value++;
    return all;
  }();
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned group = 0, bits = 0;
  for (const char digit : text) {
    const unsigned value = values[static_cast<unsigned char>(digit)];
    if (value == none) return std::nullopt;
    group = group << 6 | value;
    if ((bits += 6) < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255);
  }
  return bytes;
}

} // namespace nephroid
