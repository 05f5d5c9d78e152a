// SPDX-License-Identifier: Apache-2.0
#include "preset/expected.h"

#include <fmt/format.h>

#include <cmath>

namespace nephroid::preset {
namespace {

std::string range(const Bounds& b)
{
  const bool low = std::isfinite(b.low), high = std::isfinite(b.high);
  const auto ends = [&](const char* l, const char* h) {
    return low && high ? fmt::format(" {} {} {} {}", l, b.low, h, b.high) : low ? fmt::format(" {} {}", l, b.low) : "";
  };
  if (b.without_low && b.without_high) return ends("above", "and below");
  return low && high ? fmt::format(" from {} to {}", b.low, b.high) : low ? fmt::format(" of at least {}", b.low) : "";
}

std::string in(std::string_view unit) { return unit.empty() ? "" : fmt::format(" {}", unit); }

} // namespace

std::string expected_number(const Bounds& bounds, std::string_view unit) { return "a number" + range(bounds) + in(unit); }

std::string expected_integer(const Bounds& bounds, std::string_view unit)
{
  // Whole numbers read better without an exponent: 16777216, not 1.6777216e+07.
  // 2^64 as a bound stands for the largest 64-bit number, which no double is.
  const std::string high = bounds.high < 18446744073709551615.0 ? fmt::format("{:.0f}", bounds.high) : "18446744073709551615";
  return fmt::format("a whole number from {:.0f} to {}", bounds.low, high) + in(unit);
}

std::string expected_list(std::size_t count, const std::string& each) { return fmt::format("a list of {} items, each {}", count, each); }

std::string expected_list(const Count& count, const std::string& each)
{
  return fmt::format("a list of {}, each {}", expected_count(count), each);
}

std::string expected_count(const Count& count)
{
  if (count.low == 0) return fmt::format("at most {} items", count.high);
  return fmt::format("{} to {} items", count.low, count.high);
}

} // namespace nephroid::preset
