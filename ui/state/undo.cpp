// SPDX-License-Identifier: Apache-2.0
#include "ui/state/undo.h"

#include "preset/animation.h"
#include "preset/differences.h"

#include <algorithm>

namespace nephroid::ui {
namespace {

std::shared_ptr<const preset::Preset> in_frame(const std::shared_ptr<const preset::Preset>& preset, int frame) {
  const int now = preset->provenance.frame.value_or(0);
  return preset->animation && frame != now ? std::make_shared<const preset::Preset>(preset::shown_at(*preset, frame))
                                           : preset;
}

} // namespace

UndoStack::UndoStack(preset::Preset opened, preset::Sweep sweep) {
  state_.opened = std::make_shared<const preset::Preset>(std::move(opened));
  state_.entries = {{"", state_.opened, 0, std::move(sweep)}};
  state_.saved = 0;
  show_again();
}

int UndoStack::frame() const {
  const auto& animation = in_file()->animation;
  return animation ? std::clamp(state_.frame, 0, animation->frames - 1) : 0;
}

void UndoStack::show(int frame) {
  state_.frame = frame;
  shown_ = in_frame(in_file(), this->frame());
}

void UndoStack::push(std::string label, preset::Preset preset, preset::Sweep sweep) {
  const std::shared_ptr<const preset::Preset> before = in_file();
  push(std::move(label), std::move(preset));
  Entry& entry = state_.entries[state_.index];
  entry.sweep = std::move(sweep);
  if (*entry.preset == *before) entry.preset = before; // equal presets share one object
  show_again();
}

void UndoStack::push(std::string label, preset::Preset preset, std::uint64_t gesture) {
  auto& [opened, entries, index, saved, frame] = state_;
  entries.resize(index + 1);
  if (saved && *saved > index) saved.reset();
  // Whatever frame the fields are of: its tracks say what they are.
  if (preset.animation) preset = preset::shown_at(preset, 0);
  preset.provenance.frame.reset();
  auto pushed = std::make_shared<const preset::Preset>(std::move(preset));
  if (gesture != 0 && entries.back().gesture == gesture) {
    entries.back().preset = std::move(pushed);
    if (saved == index) saved.reset();
    return show_again();
  }
  entries.push_back({std::move(label), std::move(pushed), gesture, entries.back().sweep});
  ++index;
  if (entries.size() > limit) {
    entries.pop_front();
    --index;
    if (saved) saved = *saved > 0 ? std::optional(*saved - 1) : std::nullopt;
  }
  show_again();
}

bool UndoStack::step(int by) {
  auto& [opened, entries, index, saved, frame] = state_;
  const std::size_t to = index + static_cast<std::size_t>(by); // wraps around before the first entry
  if (to >= entries.size()) return false;
  entries[index].gesture = entries[to].gesture = 0; // a gesture that goes on after undo makes a new entry
  index = to;
  show_again();
  return true;
}

void UndoStack::fit_white(double white) {
  fitted_ = white;
  for (Entry& entry : state_.entries) {
    if (entry.preset->white) continue;
    preset::Preset fitted = *entry.preset;
    fitted.white = white;
    entry.preset = std::make_shared<const preset::Preset>(std::move(fitted));
  }
  show_again();
}

void UndoStack::mark_saved(const std::string& source) {
  for (Entry& entry : state_.entries) {
    preset::Preset saved = preset::moved_to_file(*entry.preset, source);
    saved.provenance = {}; // the file has every value now
    entry.preset = std::make_shared<const preset::Preset>(std::move(saved));
  }
  state_.saved = state_.index;
  show_again();
}

} // namespace nephroid::ui
