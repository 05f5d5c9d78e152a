// SPDX-License-Identifier: Apache-2.0
// An animation in its folder: frame_0003.png and frame_0003.exr of each frame, the run that made it in frames/0003,
// figures of all frames in frames.csv, the video animation.mp4.
#pragma once
#include "run/folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::run {

/// frames/0003 in the animation's folder: the folder of the frame's own run.
std::filesystem::path frame_folder(const std::filesystem::path& folder, int frame);
/// frame_0003.png in the animation's folder; beside it lies frame_0003.exr.
std::filesystem::path frame_picture(const std::filesystem::path& folder, int frame);

/// Puts the pictures of the frame's run beside those of the other frames, as links or else as copies. Throws failed.
void show_frame(const std::filesystem::path& folder, int frame);
/// Takes them away again, and animation.mp4 with them: before the frame is rendered another time.
void hide_frame(const std::filesystem::path& folder, int frame);

/// The frame's run, if it is the finished run of exactly this preset and its pictures can be read. before: what the
/// frame before left, or null; its `changed` says so where the run began with something else of that frame.
std::optional<FinishedRun> finished_frame(const std::filesystem::path& folder, int frame, const preset::Preset& preset,
                                          const Afterimage* before);
/// The folder of the frame before, where that is finished and left something to begin with; else empty.
std::filesystem::path frame_before(const std::filesystem::path& folder, int frame, const preset::Preset& animation);
/// The frames of the preset's animation whose runs are finished and of the files as they are, in order.
std::vector<int> finished_frames(const std::filesystem::path& folder, const preset::Preset& preset);

/// Removes frames from `first` on, each with its run, and then frames.csv and animation.mp4, which were of them too.
void remove_frames(const std::filesystem::path& folder, int first);

/// frames.csv: "frame,step,work,work_seconds,error", a row for each of these frames; the error is empty where nothing
/// measured it. Throws failed as all writing does, and bad_input where a run.json is damaged.
void write_frame_figures(const std::filesystem::path& folder, const std::vector<int>& frames);

/// Makes animation.mp4 (H.264, 4:2:0, edge lengths made even) of so many frame_0000.png, ... by the program ffmpeg.
/// Returns nothing where it is written, else why it is not.
std::optional<std::string> make_video(const std::filesystem::path& folder, int frames, double fps);

} // namespace nephroid::run
