// SPDX-License-Identifier: Apache-2.0
#include "ui/view/meter_map.h"

#include "meters/in_picture.h"
#include "meters/map.h"
#include "meters/shown.h"
#include "preset/choices.h"
#include "preset/meters.h"
#include "run/prepare.h"
#include "ui/view/pinhole.h"
#include "ui/widgets/theme.h"

#include <algorithm>

namespace nephroid::ui {

void MapOnPicture::refresh(const Context& context) {
  is_shown_ = false;
  const std::string& name = context.view_state.view_settings.meter;
  const auto& snapshot = context.run.snapshot();
  const auto& view = context.run.scene_facts().view;
  if (name.empty() || !snapshot || !snapshot->meters || !view || !context.run.snapshot_is_current() ||
      !context.comparing.shows_run_alone())
    return;
  const auto shown =
      std::ranges::find(snapshot->meters->meters, name, [](const meters::Shown& m) { return m.meter.name; });
  if (shown == snapshot->meters->meters.end() || !shown->reading) return;
  const auto& newest = seen_.newest();
  const bool fits = newest && newest->loaded == view->loaded && newest->surface == shown->surface;
  seen_.want(
      context.tasks, "finding a meter's cells in the picture", fits, true,
      [loaded = view->loaded, surface = shown->surface] {
        return std::make_shared<const Seen>(
            Seen{loaded, surface, meters::cells_in_picture(loaded->scene, *loaded->bvh, *surface)});
      },
      TaskQueue::Clock::now());
  if (!fits || newest->cells.empty()) return;
  if (coloured_seen_ != newest || coloured_reading_ != shown->reading) colour(*shown, *newest);
  coloured_seen_ = newest;
  coloured_reading_ = shown->reading;
  is_shown_ = true;
}

void MapOnPicture::colour(const meters::Shown& shown, const Seen& seen) {
  constexpr unsigned char cover = 225; // of 255: edges of the picture show through
  const preset::Meter::Unit unit = preset::unit_of(shown.meter);
  const std::vector<float> values = meters::shown_values(shown.meter, *shown.reading);
  unit_ = preset::word(unit);
  high_ = meters::map_scale(values, preset::threshold_in(shown.meter, unit));
  const scene::Camera& camera = seen.loaded->scene.camera;
  size_ = {camera.width, camera.height};
  const std::span<unsigned char> bytes = texture_.edit(camera.width, camera.height);
  for (std::size_t i = 0; i < seen.cells.size(); ++i) {
    const int cell = seen.cells[i];
    const auto rgb =
        cell < 0 ? std::array<unsigned char, 3>{} : measure::map_colour(values[static_cast<std::size_t>(cell)] / high_);
    std::ranges::copy(rgb, bytes.begin() + static_cast<std::ptrdiff_t>(4 * i));
    bytes[4 * i + 3] = cell < 0 ? 0 : cover;
  }
}

void MapOnPicture::draw(const Placement& placement) const {
  if (!is_shown_) return;
  texture_.draw(vec(placement.to_screen({0, 0})),
                vec(placement.to_screen({static_cast<double>(size_[0]), static_cast<double>(size_[1])})),
                placement.scale >= 3);
}

} // namespace nephroid::ui
