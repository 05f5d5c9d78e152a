// SPDX-License-Identifier: Apache-2.0
// Renders the frames of an animation in order, each as a run of its own, into the animation's folder (animation.h),
// then the figures of all and the video. Whoever asks for it renders one frame: the command line, or the window.
#pragma once
#include "run/ready.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::run {

/// A frame to be rendered, as make_ready takes it: is_frame, and into this folder.
struct FilmFrame {
  int frame = 0;
  preset::Preset preset;
  std::filesystem::path folder;
  std::filesystem::path frame_before; ///< ReadyOptions::frame_before
  std::shared_ptr<mpi::Ranks> ranks;  ///< that render it together; null: this process alone
};

struct FilmOptions {
  std::filesystem::path folder; ///< of the animation
  int first = 0, last = 0;      ///< the frames to be rendered
  bool is_part = false;         ///< other processes may render the other frames, and these stay
  bool resume = false;          ///< finished frames stay
  std::shared_ptr<mpi::Ranks> ranks = {};
  Watch watch = {};
  /// Renders the frame, within preset::at_origins, and shows it (show_frame) where it is finished.
  std::function<void(const FilmFrame&)> render = {};
  /// Hears of a finished frame that stays.
  std::function<void(const FilmFrame&, const FinishedRun&)> kept = {};
  /// Hears why a finished frame does not stay.
  std::function<void(const std::string& changed)> starts_anew = {};
};

struct FilmResult {
  int rendered = 0;                        ///< frames, now
  std::vector<int> finished = {};          ///< of all; on rank 0
  std::optional<std::string> why_no_video; ///< nothing: animation.mp4 is there
};

/// animation: with a number for white. Throws bad_input before the first frame where one of them cannot be rendered,
/// and as `render`, make_ready and write_frame_figures do. Frames that begin with the one before are rendered by all
/// ranks together, others each by one.
FilmResult make_film(ReadyRun& run, const preset::Preset& animation, const FilmOptions& options);

} // namespace nephroid::run
