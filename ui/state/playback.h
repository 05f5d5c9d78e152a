// SPDX-License-Identifier: Apache-2.0
// Plays the preset's animation in the View: frame after frame, each shown coarsely by the run in hand before the next
// one comes. Where the machine is slower than the film, frames are left out.
#pragma once
#include "ui/state/document.h"

#include <chrono>

namespace nephroid::ui {

class Playback {
public:
  using Clock = std::chrono::steady_clock;

  /// All outlive the object.
  Playback(Document& document, const RunInHand& run, Messages& messages)
      : document_(document), run_(run), messages_(messages) {}

  bool playing() const { return playing_; }
  /// Does nothing where there is no animation.
  void carry_out(const command::Play& c);
  /// Called once a frame of the window, after RunInHand::update. An edit, another frame that somebody chooses, and a
  /// run that was paused or ended end it.
  void update(Clock::time_point now);

private:
  bool goes_on();

  Document& document_;
  const RunInHand& run_;
  Messages& messages_;
  bool playing_ = false;
  std::shared_ptr<const preset::Preset> kept_; ///< what is played
  int frame_ = 0;                              ///< the newest that it has shown
  std::optional<Clock::time_point> since_;     ///< when that was due; nothing: its picture is still to come
};

} // namespace nephroid::ui
