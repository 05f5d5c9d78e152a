// SPDX-License-Identifier: Apache-2.0
// What a lens becomes, before it is designed: depth, steepness and triangles of a coarse one after its first step.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

struct LensForecast {
  double relief_mm = 0;        ///< from the lowest corner of a facet to the highest
  double steepest_deg = 0;     ///< against the front
  std::uint64_t triangles = 0; ///< of the solid
};

/// As if 'max_slope_deg' set no limit. Takes up to a second.
LensForecast forecast(const Layout& layout, const Target& target, double mesh_error);

/// Sentences on a deep lens, and on limits that it is not going to keep.
std::vector<std::string> forecast_notes(const Settings& settings, const LensForecast& lens);

} // namespace nephroid::inverse
