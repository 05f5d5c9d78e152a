// SPDX-License-Identifier: Apache-2.0
// A video of an animation's frames.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace nephroid::run {

/// Makes animation.mp4 (H.264, 4:2:0, edge lengths made even) of frame_0000.png to the last of so many frames in the folder, by the program
/// ffmpeg. Returns nothing where it is written, else why it is not: there is no ffmpeg on the PATH, or what ffmpeg says.
std::optional<std::string> make_video(const std::filesystem::path& folder, int frames, double fps);

} // namespace nephroid::run
