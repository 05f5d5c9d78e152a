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
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return line;
}

} // namespace

Error::Error(ErrorKind kind, std::string where, std::string what, std::string expected, std::string remedy)
    : std::runtime_error(one_line(where, what, expected, remedy)), kind_(kind), where_(std::move(where))
{
}

} // namespace nephroid
