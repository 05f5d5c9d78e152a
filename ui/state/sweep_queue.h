// SPDX-License-Identifier: Apache-2.0
// The runs of a sweep, one after the other in place of the run in hand, because a device works on one run at a time.
// Each is pinned when it is done.
#pragma once
#include "preset/read.h"
#include "ui/state/comparing.h"
#include "ui/state/document.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

class SweepQueue {
public:
  /// A pinned run keeps its picture: more runs than these are for `nephroid run`.
  static constexpr std::size_t most_runs = 64;

  enum class State { waiting, running, done, failed, stopped };
  struct QueuedRun {
    std::string name;
    std::shared_ptr<const preset::Preset> preset; ///< null where it was refused
    State state = State::waiting;
    std::string why; ///< it failed: one line
    double part = 0; ///< 0..1 of a run that is running or was stopped
  };

  /// All outlive it.
  SweepQueue(const Document& document, RunInHand& run, Comparing& comparing)
      : document_(document), run_(run), comparing_(comparing) {}

  /// Throws bad_input as preset::swept_runs, for no sweep and for more than most_runs; what is refused alone is a
  /// failed run. Nothing changes then.
  void carry_out(const command::StartSweep&);
  void carry_out(const command::StopSweep&) { stop(); }
  /// Without a sweep the run in hand is cancelled.
  void carry_out(const command::Cancel&) { active_ ? stop() : run_.cancel(); }
  /// The run in hand is of the present preset again; what is done stays pinned.
  void stop();
  /// Once a frame, after RunInHand::update.
  void update();

  /// Whether runs are to come or one is running.
  bool active() const { return active_; }
  /// Of the newest sweep that was started, in their order.
  const std::vector<QueuedRun>& runs() const { return runs_; }
  /// "3 of 10 done, 1 failed".
  std::string summary() const;

private:
  void begin_next();

  const Document& document_;
  RunInHand& run_;
  Comparing& comparing_;
  std::vector<QueuedRun> runs_;
  std::size_t at_ = 0; ///< which is running
  bool active_ = false, lent_ = false;
};

} // namespace nephroid::ui
