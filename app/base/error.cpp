// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

namespace nephroid {
namespace {

std::string one_line(const std::string& where, const std::string& what, const std::string& expected, const std::string& remedy)
{
  std::string line = where.empty() ? what : where + ": " + what;
  for (const std::string* part : {&expected, &remedy})
    if (!part->empty()) line += "; " + *part;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' '; // also what would move a terminal's cursor
  return line;
}

} // namespace

Error::Error(ErrorKind kind, std::string where, std::string what, std::string expected, std::string remedy)
    : std::runtime_error(one_line(where, what, expected, remedy)), kind_(kind), where_(std::move(where))
{
}

} // namespace nephroid
