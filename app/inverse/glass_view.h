// SPDX-License-Identifier: Apache-2.0
// The finished object as lit glass over its receivers, for engine 1: among the files of a run.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

inline constexpr const char* glass_view_file = "view.json";

/// The view as JSON: a preset of engine 1 that stands beside object.obj. It has the object as often as there are
/// receivers, side by side, each over one receiver at its distance. So the design's light must be parallel: a lamp
/// would light all copies. The camera sees them from the front and above, where no object hides its receiver, as far as
/// the distances allow. Light without colours gets glass with the design's index at all wavelengths.
std::string glass_view(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset);

} // namespace nephroid::inverse
