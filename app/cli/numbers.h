// SPDX-License-Identifier: Apache-2.0
// Numbers as people type them.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace nephroid::cli {

/// 3, +3, .02, 5., 1e5. Nothing where it is none or, of whole numbers, is not whole or not exact.
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

} // namespace nephroid::cli
