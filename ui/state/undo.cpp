// SPDX-License-Identifier: Apache-2.0
#include "ui/state/undo.h"

#include "preset/differences.h"

#include <utility>

namespace nephroid::ui {

UndoStack::UndoStack(preset::Preset opened) : opened_(opened), entries_{{"", std::move(opened), 0}} {}

void UndoStack::push(std::string label, preset::Preset preset, std::uint64_t gesture)
{
  entries_.resize(index_ + 1);
  if (saved_ && *saved_ > index_) saved_.reset();
  if (gesture != 0 && entries_.back().gesture == gesture) {
    entries_.back().preset = std::move(preset);
    if (saved_ == index_) saved_.reset();
    return;
  }
  entries_.push_back({std::move(label), std::move(preset), gesture});
  ++index_;
  if (entries_.size() <= limit) return;
  entries_.pop_front();
  --index_;
  if (saved_) saved_ = *saved_ > 0 ? std::optional(*saved_ - 1) : std::nullopt;
}

bool UndoStack::undo()
{
  if (index_ == 0) return false;
  entries_[index_].gesture = 0; // a gesture that goes on after undo is a new entry
  --index_;
  entries_[index_].gesture = 0;
  return true;
}

bool UndoStack::redo()
{
  if (index_ + 1 >= entries_.size()) return false;
  entries_[index_].gesture = 0;
  ++index_;
  return true;
}

void UndoStack::mark_saved(const std::string& source)
{
  for (Entry& entry : entries_) {
    entry.preset = preset::moved_to_file(std::move(entry.preset), source);
    entry.preset.provenance = {}; // the file holds every value now
  }
  saved_ = index_;
}

} // namespace nephroid::ui
