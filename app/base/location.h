// SPDX-License-Identifier: Apache-2.0
// What a message is about: a file or whatever else has a name, and in it a line or a value.
#pragma once
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace nephroid {

/// Escapes a key for a JSON pointer (RFC 6901): '~' becomes "~0" and '/' becomes "~1".
std::string pointer_key(std::string_view key);

struct Location {
  Location() = default;
  Location(std::string subject) : name(std::move(subject)) {}
  Location(const char* subject) : name(subject) {}
  Location(const std::filesystem::path& file) : name(file.string()) {}
  Location(std::string file, std::size_t line_in_it, std::size_t column_in_it = 0)
      : name(std::move(file)), line(line_in_it), column(column_in_it) {}
  Location(std::string file, std::string pointer_in_it) : name(std::move(file)), pointer(std::move(pointer_in_it)) {}

  std::string name;                   ///< a file, or an option, a device, a kernel, a call; may be empty
  std::size_t line = 0, column = 0;   ///< in the file, from 1; 0: none
  std::optional<std::string> pointer; ///< JSON pointer of a value in the file; "" is the outermost value
  std::string field; ///< JSON pointer of the preset's field whose value it is (preset/origins.h); or empty

  /// The place of the value's member or item.
  Location operator/(std::string_view key) const;
  template <std::integral Index>
  Location operator/(Index index) const {
    return *this / std::to_string(index);
  }
  bool operator==(const Location&) const = default;

  /// "FILE", "FILE:LINE:COLUMN" or "FILE#/json/pointer".
  std::string text() const;
};

} // namespace nephroid
