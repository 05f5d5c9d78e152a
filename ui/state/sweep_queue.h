// SPDX-License-Identifier: Apache-2.0
// The runs of a sweep. A device works on one run at a time, so they take the place of the run in hand one after the
// other. Each is pinned when it is done.
#pragma once
#include "preset/read.h"
#include "ui/state/document.h"

namespace nephroid::ui {

class SweepQueue {
public:
  /// The most runs here, because a pinned run keeps its picture; `nephroid run` takes more.
  static constexpr std::size_t most_runs = 64;

  enum class State { waiting, running, done, failed, stopped };
  struct QueuedRun {
    std::string name;
    std::shared_ptr<const preset::Preset> preset; ///< null where the preset was refused
    State state = State::waiting;
    std::string why; ///< why it failed, in one line
    double part = 0; ///< the finished part of a run that is running or was stopped, 0..1
  };

  /// document, run and comparing outlive the object.
  SweepQueue(const Document& document, RunInHand& run, Comparing& comparing)
      : document_(document), run_(run), comparing_(comparing) {}

  /// Throws bad_input as preset::swept_runs, for no sweep and for more than most_runs, and changes nothing then. A
  /// single refused preset is a failed run.
  void carry_out(const command::StartSweep&);
  void carry_out(const command::StopSweep&) { stop(); }
  /// Cancels the run in hand where no sweep is active.
  void carry_out(const command::Cancel&) { active_ ? stop() : run_.cancel(); }
  /// Gives the run in hand back to the present preset; finished runs stay pinned.
  void stop();
  /// Called once a frame, after RunInHand::update.
  void update();

  bool active() const { return active_; }
  /// The runs of the newest sweep, in their order.
  const std::vector<QueuedRun>& runs() const { return runs_; }
  /// "3 of 10 done, 1 failed".
  std::string summary() const;

private:
  void begin_next();

  const Document& document_;
  RunInHand& run_;
  Comparing& comparing_;
  std::vector<QueuedRun> runs_;
  std::size_t at_ = 0; ///< the running one
  bool active_ = false, lent_ = false;
};

} // namespace nephroid::ui
