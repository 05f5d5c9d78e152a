// SPDX-License-Identifier: Apache-2.0
// Walks PLY elements by their declared types (Turk 1994, "The PLY polygon file format") and GLB's header (glTF 2.0,
// section 4.4).
#include "scene/mesh_parts.h"

#include "base/error.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace nephroid::scene {
namespace {

struct Property {
  bool list = false;
  std::size_t count_bytes = 0; ///< list: size of the number of items
  std::size_t bytes = 0;       ///< size of the value, or of one item
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian } format = Format::ascii;
  std::vector<Element> elements;
  std::size_t body = 0; ///< offset of the first byte after the header
};

std::string_view next_token(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
  const std::string_view token = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return token;
}

std::size_t type_bytes(std::string_view type, const Location& where) {
  constexpr std::pair<std::string_view, std::size_t> types[] = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  for (const auto& [name, bytes] : types)
    if (name == type) return bytes;
  throw bad_input(where, fmt::format("the PLY header has the unknown type '{}'", printable(type)),
                  "char, short, int, float, double or a kin of these");
}

void read_property(std::string_view line, Element& element, const Location& where) {
  Property property;
  std::string_view type = next_token(line);
  property.list = type == "list";
  if (property.list) {
    property.count_bytes = type_bytes(next_token(line), where);
    type = next_token(line);
  }
  property.bytes = type_bytes(type, where);
  element.properties.push_back(property);
}

PlyHeader read_ply_header(std::string_view bytes, const Location& where) {
  PlyHeader header;
  std::size_t begin = 0;
  while (begin < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    std::string_view line = bytes.substr(begin, end - begin);
    begin = end + 1;
    const std::string_view word = next_token(line);
    if (word == "end_header") {
      header.body = std::min(begin, bytes.size());
      return header;
    }
    if (word == "format") {
      const std::string_view format = next_token(line);
      header.format =
          format == "ascii"                  ? PlyHeader::Format::ascii
          : format == "binary_little_endian" ? PlyHeader::Format::little_endian
          : format == "binary_big_endian"
              ? PlyHeader::Format::big_endian
              : throw bad_input(where, fmt::format("the PLY header has the unknown format '{}'", printable(format)),
                                "ascii, binary_little_endian or binary_big_endian");
    } else if (word == "element") {
      const std::string_view name = next_token(line), count = next_token(line);
      const auto number = number_in<std::uint64_t>(count);
      if (!number)
        throw bad_input(where,
                        fmt::format("the PLY header declares '{}' elements '{}'", printable(count), printable(name)),
                        "a number from 0 to 2^64 - 1");
      header.elements.push_back({std::string(name), *number, {}});
    } else if (word == "property") {
      if (header.elements.empty()) throw bad_input(where, "the PLY header has a property before any element");
      read_property(line, header.elements.back(), where);
    }
  }
  throw bad_input(where, "the PLY header has no end_header", "a whole file", "write it again");
}

/// Walks over one text element; false where the text ends first or a list has no proper length.
bool skip_text(std::string_view& text, const Element& element) {
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.list) {
      const auto count = number_in<std::uint64_t>(next_token(text));
      if (!count || *count > text.size()) return false;
      values = *count;
    }
    for (std::uint64_t i = 0; i < values; ++i)
      if (next_token(text).empty()) return false;
  }
  return true;
}

std::uint64_t read_count(std::string_view bytes, std::size_t size, bool big_endian) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[big_endian ? i : size - 1 - i]);
  return value;
}

bool skip_binary(std::string_view& bytes, const Element& element, bool big_endian) {
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.list) {
      if (bytes.size() < property.count_bytes) return false;
      values = read_count(bytes, property.count_bytes, big_endian);
      bytes.remove_prefix(property.count_bytes);
    }
    if (values > bytes.size() / property.bytes) return false;
    bytes.remove_prefix(values * property.bytes);
  }
  return true;
}

void check_ply(std::string_view bytes, const Location& where) {
  const PlyHeader header = read_ply_header(bytes, where);
  std::string_view rest = bytes.substr(header.body);
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const bool there = header.format == PlyHeader::Format::ascii
                             ? skip_text(rest, element)
                             : skip_binary(rest, element, header.format == PlyHeader::Format::big_endian);
      if (!there)
        throw bad_input(where,
                        fmt::format("the file ends in element {} '{}' of the {} that its header declares", i,
                                    printable(element.name), element.count),
                        "a whole file", "copy or write it again");
    }
  }
}

void check_glb(std::string_view bytes, const Location& where) {
  const std::uint64_t declared = bytes.size() < 12 ? 12 : read_count(bytes.substr(8), 4, false);
  if (declared > bytes.size())
    throw bad_input(where,
                    fmt::format("the file has {} bytes of the {} that its header declares", bytes.size(), declared),
                    "a whole file", "copy or write it again");
}

} // namespace

void check_declared_size(std::string_view bytes, const Location& where) {
  const bool named_ply =
      bytes.starts_with("ply") && (bytes.size() == 3 || !std::isalnum(static_cast<unsigned char>(bytes[3])));
  if (named_ply) check_ply(bytes, where);
  if (bytes.starts_with("glTF")) check_glb(bytes, where);
}

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 200;
  std::string result(text.substr(0, longest));
  for (char& c : result)
    if (c < ' ' || c > '~') c = c == '\n' || c == '\t' ? ' ' : '?';
  while (!result.empty() && (result.back() == '.' || result.back() == ' ')) result.pop_back();
  return result;
}

} // namespace nephroid::scene
