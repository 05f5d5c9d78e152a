// SPDX-License-Identifier: Apache-2.0
// Limits and units that many fields share: describe.h says how they were chosen.
#pragma once
#include "preset/field.h"

namespace nephroid::preset {

inline constexpr Bounds index_bounds = within(0.01, 100);
inline constexpr Bounds wavelength_bounds = within(1, 1e6);
inline constexpr Bounds coefficient_bounds = within(-1e6, 1e6);
inline constexpr Bounds position_bounds = within(-1e7, 1e7);
inline constexpr Bounds length_bounds = within(1e-6, 1e7);
inline constexpr Bounds power_bounds = within(0, 1e9);
inline constexpr Count term_count{1, 16};
inline constexpr std::size_t max_rows = 100000;
inline constexpr std::string_view length_unit = "length units";

} // namespace nephroid::preset
