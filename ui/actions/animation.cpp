// SPDX-License-Identifier: Apache-2.0
// The menu "Animation": which frame is shown, and the film.
#include "ui/actions/table.h"

namespace nephroid::ui {
namespace {

bool has_animation(C c) { return c.preset() && c.preset()->animation; }
std::string no_animation(C c) { return c.preset() ? "the preset has no animation" : "no preset is open"; }
bool can_show(C c) { return has_animation(c) && !c.sweep.active(); }
std::string why_not_show(C c) { return c.sweep.active() ? "the sweep is running" : no_animation(c); }
/// Frames follow each other where the run makes their pictures.
bool rests(C c) {
  const job::State state = c.run.status().state;
  return state == job::State::paused || state == job::State::cancelled || state == job::State::failed;
}
bool can_play(C c) { return can_show(c) && !rests(c); }
std::string why_not_play(C c) {
  return !can_show(c) ? why_not_show(c) : "the run is paused, cancelled or failed: start it again first";
}

/// Round and round.
template <int step>
void show_next(C c) {
  const int frames = c.preset()->animation->frames;
  c.push(command::ShowFrame{(c.edits->frame() + step + frames) % frames});
}

} // namespace

std::vector<Action> animation_actions() {
  return {
      switching({"Play", shift | ImGuiKey_Space, "Frame after frame at the film's pace, as far as the machine keeps up",
                 can_play, [](C c) { c.push(command::Play{!c.playback.playing()}); }, why_not_play},
                [](C c) { return c.playback.playing(); }),
      repeating({"Next frame", shift | ImGuiKey_Period,
                 "Show the next frame of the animation; after the last the first", can_show, show_next<1>}),
      repeating({"Frame before", shift | ImGuiKey_Comma, "The other way round", can_show, show_next<-1>}),
      {"First frame", shift | ImGuiKey_Home, "Show frame 0", can_show, push<command::ShowFrame>},
      {"Record the film...", 0, "Render all frames into a folder, as nephroid run does: pictures, and the video",
       [](C c) { return has_animation(c) && !c.film.active(); }, ask<Question::record>,
       [](C c) { return c.film.active() ? "a film is being recorded" : no_animation(c); }},
      {"Stop recording", 0, "What is rendered stays; recording into the same folder goes on there",
       [](C c) { return c.film.active(); }, push<command::StopFilm>,
       [](C) { return std::string("nothing is recorded"); }},
  };
}

} // namespace nephroid::ui
