// SPDX-License-Identifier: Apache-2.0
// Numbers of texts: as files have them, and as people type them.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace nephroid {

/// The number that the whole text spells; nothing if it spells none or is out of range. "nan" and "inf" are numbers,
/// "+3" is none.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// A number as people type it: 3, +3, .02, 5., 1e5. Nothing if it is no number, or, for an integer type, if it is not
/// whole or not exact.
template <class Number>
std::optional<Number> typed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (const std::optional<Number> number = number_in<Number>(text)) return number;
  if constexpr (std::integral<Number>) {
    constexpr double exact = 1ll << 53;
    const std::optional<double> value = number_in<double>(text);
    if (value && std::abs(*value) <= std::min(exact, static_cast<double>(std::numeric_limits<Number>::max())) &&
        std::trunc(*value) == *value && (*value >= 0 || std::signed_integral<Number>))
      return static_cast<Number>(*value);
  }
  return std::nullopt;
}

} // namespace nephroid
