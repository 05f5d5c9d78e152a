// SPDX-License-Identifier: Apache-2.0
// Skies whose sun is below the horizon. They are dark, and that is said before any work.
#pragma once
#include "preset/preset.h"

#include <string>

namespace nephroid::run {

/// Whether the preset's sky is dark.
bool is_night(const preset::Preset& preset);

/// A line of who puts the sun below the horizon, and in which frames of an animation. Empty: nobody.
std::string night_note(const preset::Preset& preset);

/// The preset, or of an animation that begins at night its first frame by day.
preset::Preset by_day(const preset::Preset& preset);

} // namespace nephroid::run
