// SPDX-License-Identifier: Apache-2.0
// What a lens becomes, before it is designed: depth, steepness and triangles of a coarse one.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

struct LensForecast {
  double relief_mm = 0;        ///< from the lowest corner of a facet to the highest
  double steepest_deg = 0;     ///< against the front
  double mesh_error = 0;       ///< of its triangles, in cells
  std::uint64_t triangles = 0; ///< of the solid
};

/// As if 'max_slope_deg' set no limit. Takes a second or two.
LensForecast forecast(const Layout& layout, const Target& target, std::optional<double> mesh_error);

/// Sentences on a deep lens, and on limits that it is not going to keep.
std::vector<std::string> forecast_notes(const Settings& settings, const LensForecast& lens);

} // namespace nephroid::inverse
