// SPDX-License-Identifier: Apache-2.0
// What a panel reads, and where its commands go. A new one is made for every frame.
#pragma once
#include "ui/state/film_recording.h"
#include "ui/state/material_balls.h"
#include "ui/state/playback.h"
#include "ui/state/recent_files.h"
#include "ui/state/sweep_queue.h"
#include "ui/state/tone.h"

namespace nephroid::ui {

struct Context {
  const UndoStack* edits; ///< the preset that is edited, with its history; null before one is opened
  const RunInHand& run;
  const Comparing& comparing;
  const ViewState& view_state;
  const WindowSettings& settings;
  bool has_earlier_session; ///< there is an earlier session to reopen
  Commands& commands;
  const RecentFiles& recent;
  const SweepQueue& sweep;
  const Playback& playback;
  const FilmRecording& film;
  TaskQueue& tasks;     ///< for work that takes longer than a frame
  MaterialBalls& balls; ///< pictures of the materials that panels show

  /// The preset in hand; null before one is opened.
  const preset::Preset* preset() const { return edits ? &edits->current() : nullptr; }
  /// The radiance of luminance 1 (preset::Preset::white); 1 while it is unknown.
  double white() const { return edits ? edits->current().white.value_or(1) : 1; }
  /// How its pictures are shown; plain while there is none.
  image::Display display() const { return edits ? display_of(edits->current()) : image::Display(); }
  /// The selection, as far as the preset has it.
  Selection selection() const { return in_preset(view_state.selection, preset()); }
  /// A preset must be open, as for edit().
  std::string engine() const { return std::string(edits->current().settings.engine()); }
  void push(Command command) const { commands.push_back(std::move(command)); }
  /// The view settings after the commands of this frame: two keys in one frame must not undo each other.
  ViewSettings view_settings() const {
    for (auto c = commands.rbegin(); c != commands.rend(); ++c)
      if (const auto* set = std::get_if<command::SetViewSettings>(&*c)) return set->view_settings;
    return view_state.view_settings;
  }
  void note(std::string line) const { push(command::Report{std::move(line), false}); }
  /// Pushes an edit to what change(preset) makes; gesture and live as in command::Edit.
  template <class Change>
  void edit(std::string label, Change change, std::uint64_t gesture = 0, bool live = false) const {
    preset::Preset edited = edits->current();
    change(edited);
    push(command::Edit{std::move(label), std::move(edited), gesture, live});
  }
};

} // namespace nephroid::ui
