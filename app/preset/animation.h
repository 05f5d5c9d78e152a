// SPDX-License-Identifier: Apache-2.0
// A preset at a frame of its animation.
#pragma once
#include "preset/json_text.h"
#include "preset/preset.h"

#include <string>
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

/// The same in another frame, of a preset whose tracks have been checked; the frame is that of its provenance then.
Preset shown_at(const Preset& preset, int frame);

/// What an edit of a preset that is shown in a frame means, both as JSON. A field that has a track and another value
/// now has this value as its key in this frame. A track goes with its item where the edit moves or renames that in its
/// list, and away with it. Where the edit changes the animation itself, it stays as it is. Throws bad_input at `source`
/// where the field's value is no such numbers any more.
Json with_keys(const Json& before, Json edited, int frame, const std::string& source);

} // namespace nephroid::preset
