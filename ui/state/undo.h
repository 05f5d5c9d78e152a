// SPDX-License-Identifier: Apache-2.0
// Undo and redo: a stack of presets with their sweeps, because these are the whole state. Each gesture is one entry. Of
// an animation entries are frame 0, as files are; the preset in hand is that of the frame which is shown.
#pragma once
#include "preset/preset.h"
#include "preset/read.h"

#include <deque>

namespace nephroid::ui {

class UndoStack {
public:
  struct Entry {
    std::string label;
    std::shared_ptr<const preset::Preset> preset; ///< another preset is another object
    std::uint64_t gesture = 0;
    preset::Sweep sweep = {};
    bool operator==(const Entry&) const = default;
  };
  /// The whole stack, to be kept in a session.
  struct State {
    std::shared_ptr<const preset::Preset> opened;
    std::deque<Entry> entries; ///< at least one
    std::size_t index = 0;     ///< the current entry's
    std::optional<std::size_t> saved;
    int frame = 0; ///< that is shown, where the preset has an animation that long
    bool operator==(const State&) const = default;
  };

  /// Begins with one preset, which counts as saved.
  explicit UndoStack(preset::Preset opened, preset::Sweep sweep = {});
  /// Restores what state() returned.
  explicit UndoStack(State state) : state_(std::move(state)) { show(state_.frame); }
  /// Adds a state after the current one; what could be redone is dropped. The current entry's gesture (not 0) replaces
  /// that entry instead. The sweep stays.
  void push(std::string label, preset::Preset preset, std::uint64_t gesture = 0);
  /// The same with another sweep.
  void push(std::string label, preset::Preset preset, preset::Sweep sweep);
  /// Goes one entry back or forth; false where there is none.
  bool undo() { return step(-1); }
  bool redo() { return step(1); }
  /// Shows another frame of the animation from now on, the nearest that there is. This is no entry.
  void show(int frame);
  /// The shown frame; 0 without an animation.
  int frame() const;
  /// The preset in the shown frame.
  const preset::Preset& current() const { return *shown_; }
  /// Another preset is another object.
  const std::shared_ptr<const preset::Preset>& shared() const { return shown_; }
  /// The preset as its file would have it, in frame 0.
  const std::shared_ptr<const preset::Preset>& in_file() const { return state_.entries[state_.index].preset; }
  const preset::Sweep& sweep() const { return state_.entries[state_.index].sweep; }
  /// The preset as it was read.
  const preset::Preset& opened() const { return *state_.opened; }
  /// What undo() or redo() would change; empty where there is nothing.
  std::string undo_label() const { return state_.index > 0 ? state_.entries[state_.index].label : std::string(); }
  std::string redo_label() const {
    return state_.index + 1 < state_.entries.size() ? state_.entries[state_.index + 1].label : std::string();
  }
  /// The current state has been saved as `source`. All states belong to that file now, and paths in them are relative
  /// to its folder.
  void mark_saved(const std::string& source);
  /// Replaces "auto" in all states. This is not an entry of its own.
  void fit_white(double white);
  /// Whether the white is one that took the place of "auto" in this session.
  bool has_fitted_white() const { return fitted_ && shown_->white == fitted_; }
  bool modified() const { return state_.saved != state_.index; }
  const State& state() const { return state_; }

private:
  bool step(int by);
  void show_again() { show(state_.frame); }

  static constexpr std::size_t limit = 1000; ///< the most entries; a preset is a few kilobytes
  State state_;
  std::shared_ptr<const preset::Preset> shown_;
  std::optional<double> fitted_; ///< the last white in the place of "auto"
};

} // namespace nephroid::ui
