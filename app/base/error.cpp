// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

namespace nephroid {
namespace {

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      c = ' '; // control characters: some would move a terminal's cursor
  return text;
}

std::string joined(std::string what, const std::string& expected, const std::string& remedy) {
  for (const std::string* part : {&expected, &remedy})
    if (!part->empty()) what += "; " + *part;
  return on_one_line(what);
}

std::string line_of(const Location& location, const std::string& text) {
  const std::string where = location.text();
  return where.empty() ? text : on_one_line(where) + ": " + text;
}

} // namespace

Error::Error(ErrorKind kind, Location location, std::string what, std::string expected, std::string remedy)
    : std::runtime_error(line_of(location, joined(what, expected, remedy))), kind_(kind),
      location_(std::move(location)), text_(joined(std::move(what), expected, remedy)) {}

std::string pointer_key(std::string_view key) {
  std::string escaped;
  for (const char c : key) escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return escaped;
}

Location Location::operator/(std::string_view key) const {
  return {name, pointer.value_or("").append("/").append(pointer_key(key))};
}

std::string Location::text() const {
  std::string text = name;
  if (pointer) text.append("#").append(*pointer);
  for (const std::size_t number : {line, column})
    if (number > 0) text.append(":").append(std::to_string(number));
  return text;
}

} // namespace nephroid
