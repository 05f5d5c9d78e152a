// SPDX-License-Identifier: Apache-2.0
// "white": "auto" becomes a number before anything else is done, so that checkpoints, references, frames and files know
// numbers only, and a run of that number has the same bits.
#pragma once
#include "job/job.h"
#include "run/prepare.h"

#include <optional>

namespace nephroid::run {

/// The white that shows a picture, which was made with a white of 1, well: half of it, but for its caustics, is darker
/// than .5. A pixel counts by the root of its luminance. Caustics count where all else is less than an eighth as
/// bright. Two digits; 1 of a black picture.
double white_for(const job::Picture& picture);

/// What is wrong with how bright a picture is, and the white that would show it: a fifth of it or more is above white,
/// or all of it is black. Else empty. white_by: how to give that white, with {} in its place.
std::string exposure_note(const job::Picture& picture, const preset::Preset& preset,
                          const std::string& white_by = "--set white={}");

/// The same as white_for of the preset's first whole picture, at most 256 pixels wide and high: what stands for "auto".
/// Of an animation that begins at night the first frame by day is taken. 1 where white changes nothing of the engine's
/// pictures. lender: lends its scene to the small picture's run, which it then is. Throws as prepare and render_picture
/// do, and interrupted where `watch` asks for it.
double fitted_white(preset::Preset preset, std::optional<Prepared>& lender, DeviceOnDemand& device,
                    const Watch& watch = {});

} // namespace nephroid::run
