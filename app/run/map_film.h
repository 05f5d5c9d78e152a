// SPDX-License-Identifier: Apache-2.0
// What a meter shows in hour after hour, in false colours of one scale: frames with their times, and a video of them.
#pragma once
#include "meters/map.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::run {

class MapFilm {
public:
  /// Keeps the map of the next hour. title: what is written above it, one line.
  void add(const preset::Meter& meter, const meters::Reading& reading, std::string title);
  /// Writes frame_0000.png, ... into the folder, in the place of earlier ones, and the video, both of all
  /// hours that memory has room for. The scale is the largest of an hour's own. Returns why there is no video, or
  /// nothing; throws failed as writing does.
  std::optional<std::string> write(const std::filesystem::path& folder, const std::filesystem::path& video,
                                   const preset::Meter& meter, const scene::MeterSurface& surface,
                                   double metres_per_unit) const;

private:
  struct Frame {
    std::vector<float> values; ///< [cell], in the meter's unit
    std::string title;
  };
  std::vector<Frame> frames_;
  double scale_ = 0;         ///< the largest of an hour's own
  std::size_t left_out_ = 0; ///< hours that memory is not spent on
};

} // namespace nephroid::run
