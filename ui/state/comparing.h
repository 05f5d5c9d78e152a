// SPDX-License-Identifier: Apache-2.0
// The run in hand held against another picture: pinned runs, the one that is chosen, and the map of their difference in false colour, made
// beside the frames: FLIP of a large picture takes seconds, a frame 16 ms.
#pragma once
#include "measure/difference.h"
#include "ui/state/commands.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_in_hand.h"
#include "ui/state/tasks.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

/// A picture with whatever keeps its pixels alive.
struct HeldPicture {
  std::shared_ptr<const void> owner; ///< null: there is no picture
  measure::Pixels pixels;
};

struct DifferenceRequest {
  HeldPicture picture, other;
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0; ///< as Comparison::scale
};

struct ShownDifference {
  DifferenceRequest of;
  std::shared_ptr<const std::vector<float>> values; ///< a value a pixel; null where there is no map
  std::vector<unsigned char> rgba;                  ///< 4 a pixel
  double scale = 1;                                 ///< the value at the end of the colours
  std::string error;                                ///< why there is no map
};

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
  void update(TaskQueue::Clock::time_point now);

private:
  const RunInHand& run_;
  TaskQueue& tasks_;
  PinnedRuns pinned_;
  Comparison comparison_;
  NewestResult<ShownDifference> difference_;
};

} // namespace nephroid::ui
