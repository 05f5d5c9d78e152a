// SPDX-License-Identifier: Apache-2.0
#include "run/night.h"

#include "preset/animation.h"
#include "preset/origins.h"
#include "scene/sky.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::run {
namespace {

bool moves_sun(const preset::Track& track) {
  return track.path.starts_with("scene.environment.place") || track.path.starts_with("scene.environment.sun_direction");
}

bool sun_moves(const preset::Preset& preset) {
  return preset.animation && std::ranges::any_of(preset.animation->tracks, moves_sun);
}

/// For each frame whether it is at night. The tracks have been checked.
std::vector<bool> nights(preset::Preset preset) {
  std::erase_if(preset.animation->tracks, [](const preset::Track& track) { return !moves_sun(track); });
  preset.scene.objects.clear(); // a frame is read anew
  preset.scene.materials.clear();
  preset.scene.lights.clear();
  std::vector<bool> dark;
  for (int frame = 0; frame < preset.animation->frames; ++frame)
    dark.push_back(is_night(preset::shown_at(preset, frame)));
  return dark;
}

/// As --frames has them: "0-2, 18".
std::string ranges_of(const std::vector<bool>& frames) {
  std::string ranges;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i]) continue;
    const std::size_t first = i;
    while (i + 1 < frames.size() && frames[i + 1]) ++i;
    ranges += fmt::format("{}{}{}", ranges.empty() ? "" : ", ", first, i > first ? fmt::format("-{}", i) : "");
  }
  return ranges;
}

std::string who_says(const preset::Preset& preset) {
  std::string pointer =
      preset.scene.environment->place ? "/scene/environment/place/hour" : "/scene/environment/sun_direction";
  if (sun_moves(preset))
    pointer = fmt::format("/animation/tracks/{}",
                          std::ranges::find_if(preset.animation->tracks, moves_sun) - preset.animation->tracks.begin());
  return (preset.provenance.origins ? preset.provenance.origins->where(pointer) : Location(preset.source, pointer))
      .text();
}

} // namespace

bool is_night(const preset::Preset& preset) {
  return preset.scene.environment && scene::is_night(*preset.scene.environment);
}

std::string night_note(const preset::Preset& preset) {
  if (!preset.scene.environment || preset.scene.environment->type != preset::Environment::Type::sky) return {};
  std::string frames;
  if (sun_moves(preset)) {
    frames = ranges_of(nights(preset));
    if (frames.empty()) return {};
    frames = fmt::format(" in the frames {}", frames);
  } else if (!is_night(preset))
    return {};
  return fmt::format("{}: the sun is below the horizon{}: the sky, which knows no twilight, is dark; {}",
                     who_says(preset), frames,
                     preset.scene.environment->place ? "for light choose another hour, or look at the offset from UTC"
                                                     : "for light choose a direction above the horizon");
}

preset::Preset by_day(const preset::Preset& preset) {
  if (!is_night(preset) || !sun_moves(preset)) return preset;
  const std::vector<bool> dark = nights(preset);
  const auto day = std::ranges::find(dark, false);
  return day == dark.end() ? preset : preset::at_frame(preset, static_cast<int>(day - dark.begin()));
}

} // namespace nephroid::run
