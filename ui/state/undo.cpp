// SPDX-License-Identifier: Apache-2.0
#include "ui/state/undo.h"

#include "preset/differences.h"

namespace nephroid::ui {

UndoStack::UndoStack(preset::Preset opened, preset::Sweep sweep) {
  state_.opened = std::make_shared<const preset::Preset>(std::move(opened));
  state_.entries = {{"", state_.opened, 0, std::move(sweep)}};
  state_.saved = 0;
}

void UndoStack::push(std::string label, preset::Preset preset, preset::Sweep sweep) {
  const std::shared_ptr<const preset::Preset> before = shared();
  push(std::move(label), std::move(preset));
  Entry& entry = state_.entries[state_.index];
  entry.sweep = std::move(sweep);
  if (*entry.preset == *before) entry.preset = before; // equal presets share one object
}

void UndoStack::push(std::string label, preset::Preset preset, std::uint64_t gesture) {
  auto& [opened, entries, index, saved] = state_;
  entries.resize(index + 1);
  if (saved && *saved > index) saved.reset();
  auto pushed = std::make_shared<const preset::Preset>(std::move(preset));
  if (gesture != 0 && entries.back().gesture == gesture) {
    entries.back().preset = std::move(pushed);
    if (saved == index) saved.reset();
    return;
  }
  entries.push_back({std::move(label), std::move(pushed), gesture, entries.back().sweep});
  ++index;
  if (entries.size() <= limit) return;
  entries.pop_front();
  --index;
  if (saved) saved = *saved > 0 ? std::optional(*saved - 1) : std::nullopt;
}

bool UndoStack::step(int by) {
  auto& [opened, entries, index, saved] = state_;
  const std::size_t to = index + static_cast<std::size_t>(by); // wraps around before the first entry
  if (to >= entries.size()) return false;
  entries[index].gesture = entries[to].gesture = 0; // a gesture that goes on after undo makes a new entry
  index = to;
  return true;
}

void UndoStack::fit_white(double white) {
  for (Entry& entry : state_.entries) {
    if (entry.preset->white) continue;
    preset::Preset fitted = *entry.preset;
    fitted.white = white;
    entry.preset = std::make_shared<const preset::Preset>(std::move(fitted));
  }
}

void UndoStack::mark_saved(const std::string& source) {
  for (Entry& entry : state_.entries) {
    preset::Preset saved = preset::moved_to_file(*entry.preset, source);
    saved.provenance = {}; // the file has every value now
    entry.preset = std::make_shared<const preset::Preset>(std::move(saved));
  }
  state_.saved = state_.index;
}

} // namespace nephroid::ui
