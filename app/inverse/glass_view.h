// SPDX-License-Identifier: Apache-2.0
// The finished object as lit glass over its receivers, for engine 1: among the files of a run.
#pragma once
#include "inverse/layout.h"

#include <string>
#include <vector>

namespace nephroid::inverse {

inline constexpr const char* glass_view_file = "view.json";

/// Its JSON: a preset of engine 1 that stands beside object.obj. The design's light, which is parallel, falls on as
/// many copies of the object as there are receivers, side by side, each over one receiver at its distance. A lamp would
/// light all copies. The camera looks at them from the front and above, where no object hides its receiver, as far as
/// the distances allow. Of coloured light, light and glass have their spectrum and dispersion; else the glass has the
/// index that the design was made with, at all wavelengths.
std::string glass_view(const Layout& layout, const std::vector<Target>& targets, const preset::Preset& preset);

} // namespace nephroid::inverse
