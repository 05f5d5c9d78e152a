// SPDX-License-Identifier: Apache-2.0
// An animation as `nephroid run` renders it: frame by frame, then the video.
#pragma once
#include "cli/run_target.h"

namespace nephroid::cli {

/// Renders the frames that options.frames names into target.folder (run/animation.h), each as a run of its own. With options.resume those
/// that are finished are left as they are. Throws bad_input for a frame that there is not or that cannot be, before any is rendered.
void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted, Shared& shared);

} // namespace nephroid::cli
