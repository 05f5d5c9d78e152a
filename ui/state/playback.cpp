// SPDX-License-Identifier: Apache-2.0
#include "ui/state/playback.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr int least_a_round = 8; ///< pictures of a round, however slow the machine is

}

void Playback::carry_out(const command::Play& c) {
  const UndoStack* edits = document_.edits();
  playing_ = c.on && edits && edits->in_file()->animation;
  if (!playing_) return;
  kept_ = edits->in_file();
  frame_ = edits->frame();
  since_.reset();
}

bool Playback::goes_on() {
  const UndoStack* edits = document_.edits();
  if (!edits || edits->frame() != frame_) return false;
  if (edits->in_file() != kept_) { // a white that was fitted and a file that was saved are no edits
    preset::Preset same = *kept_;
    same.white = edits->in_file()->white;
    same.source = edits->in_file()->source;
    same.provenance = edits->in_file()->provenance;
    if (same != *edits->in_file()) return false;
    kept_ = edits->in_file();
  }
  const job::State state = run_.status().state;
  return state != job::State::paused && state != job::State::cancelled && state != job::State::failed;
}

void Playback::update(Clock::time_point now) {
  if (!playing_) return;
  playing_ = goes_on();
  if (!playing_ || !run_.snapshot_is_current()) return;
  if (!since_) since_ = now;
  const preset::Animation& animation = *kept_->animation;
  const double due = std::floor(std::chrono::duration<double>(now - *since_).count() * animation.fps);
  if (due < 1) return;
  const int most = std::max(1, animation.frames / least_a_round);
  const int step = due < most ? static_cast<int>(due) : most;
  // Frames that are left out are late no more.
  since_ =
      step < due
          ? now
          : *since_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(step / animation.fps));
  try {
    document_.carry_out(command::ShowFrame{(frame_ + step) % animation.frames});
    frame_ = document_.edits()->frame();
  } catch (const std::exception& error) {
    playing_ = false;
    messages_.error(error);
  }
}

} // namespace nephroid::ui
