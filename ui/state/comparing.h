// SPDX-License-Identifier: Apache-2.0
// The run in hand held against another picture: pinned runs, the one that is chosen, and the map of their difference.
#pragma once
#include "ui/state/commands.h"
#include "ui/state/difference.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_in_hand.h"

#include <memory>
#include <string>

namespace nephroid::ui {

class Comparing {
public:
  /// Both outlive it.
  Comparing(const RunInHand& run, TaskQueue& tasks) : run_(run), tasks_(tasks) {}

  const PinnedRuns& pinned() const { return pinned_; }
  const Comparison& comparison() const { return comparison_; }
  /// The run's picture, or its layer that comparison() names; its owner is null where why_no_picture() is not empty.
  HeldPicture picture() const;
  /// Why there is no such picture: a sentence without a full stop; else empty.
  std::string why_no_picture() const;
  /// The same of the reference, or of the pinned run that comparison() names; its owner is null where why_not() is not empty.
  HeldPicture other_picture() const;
  /// Why the run's picture and the other one cannot be held against each other: a sentence without a full stop; else empty.
  std::string why_not() const;
  /// The newest map of differences that comparison() asked for; may be of an earlier snapshot. Null before the first.
  const std::shared_ptr<const ShownDifference>& difference() const { return difference_.newest(); }

  void carry_out(const command::Flip& c) { comparison_.flip = c.on; }
  void carry_out(const command::CompareWith& c) { comparison_.pin = pinned_.find(c.pin) ? c.pin : 0; }
  void carry_out(const command::ShowDifference& c);
  void carry_out(const command::ShowLayer& c) { comparison_.layer = c.layer; }
  void carry_out(const command::PinRun&);
  void carry_out(const command::ChangePin& c) { pinned_.change(c.pin, c.name, c.colour, c.shown); }
  void carry_out(const command::Unpin& c);
  void pin(PinnedRun run) { pinned_.add(std::move(run)); }
  /// The map is of another preset.
  void forget()
  {
    difference_.forget(tasks_);
    comparison_.layer.clear();
  }
  /// Once a frame: asks for the map of what is shown now.
  void update(NewestDifference::Clock::time_point now);

private:
  const RunInHand& run_;
  TaskQueue& tasks_;
  PinnedRuns pinned_;
  Comparison comparison_;
  NewestDifference difference_;
};

} // namespace nephroid::ui
