// SPDX-License-Identifier: Apache-2.0
// Undo and redo: a stack of presets, because the preset is the whole state. One entry a gesture.
#pragma once
#include "preset/preset.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace nephroid::ui {

class UndoStack {
public:
  /// Starts over with one preset that counts as saved.
  explicit UndoStack(preset::Preset opened);
  /// A new state after the current one; what could be redone is dropped. The same gesture (not 0) as the current entry's replaces it.
  void push(std::string label, preset::Preset preset, std::uint64_t gesture = 0);
  /// One entry back or forth; false where there is none.
  bool undo();
  bool redo();
  const preset::Preset& current() const { return entries_[index_].preset; }
  /// As it was read.
  const preset::Preset& opened() const { return opened_; }
  /// What undo() would undo and redo() redo; empty where there is nothing.
  std::string undo_label() const { return index_ > 0 ? entries_[index_].label : std::string(); }
  std::string redo_label() const { return index_ + 1 < entries_.size() ? entries_[index_ + 1].label : std::string(); }
  /// The current state has been saved as `source`. All states belong to that file now: what they name is named as from its folder.
  void mark_saved(const std::string& source);
  bool modified() const { return saved_ != index_; }

private:
  struct Entry {
    std::string label;
    preset::Preset preset;
    std::uint64_t gesture = 0;
  };
  static constexpr std::size_t limit = 1000; ///< entries kept: a preset is a few kilobytes
  preset::Preset opened_;
  std::deque<Entry> entries_;
  std::size_t index_ = 0;
  std::optional<std::size_t> saved_ = 0;
};

} // namespace nephroid::ui
