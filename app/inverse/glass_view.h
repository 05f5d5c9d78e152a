// SPDX-License-Identifier: Apache-2.0
// The finished object as lit glass over its receivers: a preset for engine 1.
#pragma once
#include "inverse/layout.h"

#include <string>

namespace nephroid::inverse {

/// Its name among the files of a run.
inline constexpr const char* glass_view_file = "view.json";

/// JSON of a preset that stands beside object.obj. The design's light, which is parallel, falls on as many copies of the object as there
/// are receivers, side by side, each over one receiver at its distance. A lamp would light all copies. The camera looks at them from the
/// front and above, where no object hides its receiver, as far as the distances allow. The glass has the index that the design was made
/// with, at all wavelengths.
std::string glass_view(const Layout& layout, const std::vector<Target>& targets, const std::string& name);

} // namespace nephroid::inverse
