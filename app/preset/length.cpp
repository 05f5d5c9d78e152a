// SPDX-License-Identifier: Apache-2.0
#include "preset/length.h"

#include "base/numbers.h"

#include <cmath>
#include <regex>
#include <string>

namespace nephroid::preset {

std::optional<double> millimetres_of(std::string_view text) {
  constexpr std::size_t longest = 100;
  static const std::regex form(length_pattern);
  std::smatch parts;
  const std::string written(text.substr(0, longest));
  if (text.size() > longest || !std::regex_match(written, parts, form)) return std::nullopt;
  const auto number = [&](std::size_t i, double without) {
    return parts[i].matched ? number_in<double>(parts.str(i)) : without;
  };
  const std::optional<double> whole = number(1, 0), over = number(2, 0), under = number(3, 1);
  if (!whole || !over || !under || *under == 0) return std::nullopt;
  const std::string unit = parts.str(4);
  const double size = unit == "um"   ? 1e-3
                      : unit == "mm" ? 1
                      : unit == "cm" ? 10
                      : unit == "m"  ? 1e3
                      : unit == "in" ? 25.4
                                     : 304.8;
  return (*whole + *over / *under) * size;
}

} // namespace nephroid::preset
