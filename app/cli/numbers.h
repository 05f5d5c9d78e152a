// SPDX-License-Identifier: Apache-2.0
// What CLI11 does not see in an option's number: it reads "nan" as a number in any range, -1 as 2^64 - 1 and 1e30 as the largest whole
// number.
#pragma once
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace nephroid::cli {

/// Refuses what is no number, is followed by anything else, or is out of range.
template <class Number>
CLI::Validator number_from_to(Number lowest, Number highest)
{
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        Number number{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool good = error == std::errc() && end == text.data() + text.size() && number >= lowest && number <= highest;
        return good ? ""
                    : fmt::format("'{}' is not {} from {} to {}", text, std::is_integral_v<Number> ? "a whole number" : "a number", lowest,
                                  highest);
      },
      "");
}

/// Of --seed.
inline CLI::Validator any_seed() { return number_from_to<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max()); }

} // namespace nephroid::cli
