// SPDX-License-Identifier: Apache-2.0
// A number with its interval, as text and as JSON.
#pragma once
#include "meters/reading.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nephroid::meters {

/// "512.31 +- 0.2 %"; with both ends where they are not alike. unit: what the number is divided by.
inline std::string text_of(const Interval& interval, double unit = 1) {
  const double value = interval.value / unit, up = interval.high / unit - value, down = value - interval.low / unit;
  if (!(interval.half() > 0)) return fmt::format("{:.5g}", value);
  if (value > 0 && std::max(up, down) <= value && std::abs(up - down) <= 0.2 * std::max(up, down))
    return fmt::format("{:.5g} +- {:.2g} %", value, 50 * (up + down) / value);
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", value, value - down, value + up);
}

inline nlohmann::ordered_json json_of(const Interval& interval) {
  return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

} // namespace nephroid::meters
