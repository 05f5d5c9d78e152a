// SPDX-License-Identifier: Apache-2.0
// Lengths as people write them.
#pragma once
#include <optional>
#include <string_view>

namespace nephroid::preset {

/// The unit of the fields that take such a length, the units that they take, and how it is written: whole, number,
/// denominator and unit are its parts.
inline constexpr std::string_view millimetre_unit = "mm", length_units = "um, mm, cm, m, in or ft";
inline constexpr const char* length_pattern =
    R"(^\s*(?:(\d+)\s+(?=\d+/))?(-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?:/(\d+))?\s*(um|mm|cm|m|in|ft)\s*$)";

/// Millimetres of "25.4 mm", "1 in", "1/4 in" or "1 1/2 in". Empty: that is none.
std::optional<double> millimetres_of(std::string_view text);

} // namespace nephroid::preset
