// SPDX-License-Identifier: Apache-2.0
#include "run/map_film.h"

#include "base/counted.h"
#include "base/parallel.h"
#include "image/image.h"
#include "measure/difference.h"
#include "run/animation.h"

#include <algorithm>
#include <utility>

namespace nephroid::run {
namespace {

namespace fs = std::filesystem;

/// Cells of all hours together: a GiB.
constexpr std::size_t most_values = std::size_t{1} << 28;
constexpr double hours_a_second = 6;

} // namespace

void MapFilm::add(const preset::Meter& meter, const meters::Reading& reading, std::string title) {
  std::vector<float> values = meters::shown_values(meter, reading);
  scale_ = std::max(scale_, meters::map_scale(values, preset::threshold_in(meter, preset::unit_of(meter))));
  if ((frames_.size() + 1) * values.size() > most_values)
    ++left_out_;
  else
    frames_.push_back({std::move(values), std::move(title)});
}

std::optional<std::string> MapFilm::write(const fs::path& folder, const fs::path& video, const preset::Meter& meter,
                                          const scene::MeterSurface& surface, double metres_per_unit) const {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw failed(folder.string(), error.message(), "expected a folder that can be made");
  remove_frames(folder, 0);
  std::error_code ignored;
  fs::remove(video, ignored);
  for_blocks(frames_.size(), [&](std::size_t i) {
    const measure::Bitmap map =
        meters::false_colours(meter, surface, metres_per_unit, frames_[i].values, scale_, frames_[i].title);
    image::write_png_bytes(frame_picture(folder, static_cast<int>(i)), map.width, map.height, map.rgba);
  });
  if (left_out_ > 0) return counted(left_out_, "hour") + " would need more than a GiB of memory, and have no frame";
  if (auto why_not = make_video(folder, static_cast<int>(frames_.size()), hours_a_second)) return why_not;
  fs::rename(folder / "animation.mp4", video, error);
  if (error) throw failed(video.string(), error.message(), "expected a file that can be written");
  return std::nullopt;
}

} // namespace nephroid::run
