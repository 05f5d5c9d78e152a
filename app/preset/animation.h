// SPDX-License-Identifier: Apache-2.0
// A preset at a frame of its animation.
#pragma once
#include "preset/preset.h"

#include <vector>

namespace nephroid::preset {

/// The track's numbers at a frame. Its keys are by rising frame and have equally many numbers.
std::vector<double> value_at(const Track& track, int frame);

/// The preset of one frame, without an animation: each track's field has the track's value. Its name ends in
/// ",frame=12". Throws bad_input as check() does at what cannot be in this frame.
Preset at_frame(const Preset& preset, int frame);

/// The preset with its tracks' fields as they are in frame 0, its animation as it was. Throws bad_input at the first
/// track, key or value that cannot be.
Preset at_start(const Preset& preset);

} // namespace nephroid::preset
