// SPDX-License-Identifier: Apache-2.0
// What CLI11 does not see in an option's number: it reads "nan" as a number in any range, -1 as 2^64 - 1 and 1e30 as the largest whole
// number, and knows no whole number 1e5.
#pragma once
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace nephroid::cli {

/// A number as people type it: 3, +3, .02, 5., 1e5. Nothing where it is none or, of whole numbers, is not whole or not exact.
template <class Number>
std::optional<Number> typed_number(std::string_view text)
{
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto read = [text](auto& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  Number number{};
  if (read(number)) return number;
  if constexpr (std::integral<Number>) {
    constexpr double exact = 1ll << 53;
    double value = 0;
    if (read(value) && std::abs(value) <= std::min(exact, static_cast<double>(std::numeric_limits<Number>::max())) &&
        std::trunc(value) == value && (value >= 0 || std::signed_integral<Number>))
      return static_cast<Number>(value);
  }
  return std::nullopt;
}

/// Refuses what is no number, is followed by anything else, or is out of range. To be given to CLI::Option::transform: it makes the number
/// one that CLI11 reads.
template <class Number>
CLI::Validator number_from_to(Number lowest, Number highest)
{
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const std::optional<Number> number = typed_number<Number>(text);
        if (!number || !(*number >= lowest && *number <= highest))
          return fmt::format("'{}' is not {} from {} to {}", text, std::integral<Number> ? "a whole number" : "a number", lowest, highest);
        text = fmt::format("{}", *number);
        return {};
      },
      "");
}

/// Of --seed.
inline CLI::Validator any_seed() { return number_from_to<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max()); }

} // namespace nephroid::cli
