// SPDX-License-Identifier: Apache-2.0
// Two pictures held against each other: the run in hand, or a pinned run or an opened picture in its place, and another
// one of these or the reference. The map of their difference in false colour and their metrics are made beside the
// frames: FLIP of a large picture takes seconds, a frame 16 ms.
#pragma once
#include "measure/difference.h"
#include "ui/state/commands.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_in_hand.h"
#include "ui/state/services.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
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

/// How far the picture is from the other one.
struct ShownMetrics {
  HeldPicture picture, other;
  measure::Metrics metrics;
  std::string error; ///< why there are none: a line
};

class Comparing {
public:
  /// Both outlive it.
  Comparing(const RunInHand& run, Services& services) : run_(run), services_(services), tasks_(services.tasks) {}

  const PinnedRuns& pinned() const { return pinned_; }
  const Comparison& comparison() const { return comparison_; }
  /// Whether the run's picture is shown, and nothing beside it or in its place.
  bool shows_run_alone() const {
    const Comparison& c = comparison_;
    return c.shown == 0 && c.arrangement == Arrangement::single && !c.flip && !c.difference;
  }
  /// What is shown, with all of its layers: the run's, or that of the pinned run or opened picture that comparison()
  /// names. Null: none yet.
  std::shared_ptr<const job::Picture> source() const;
  /// "this run", or the name of the pinned run or picture in quotes; and of what it is compared with, "Reference" too.
  std::string name() const;
  std::string other_name() const;
  /// source() or its layer that comparison() names; its owner is null where why_no_picture() is not empty.
  HeldPicture picture() const;
  /// Why there is no such picture: a sentence without a full stop; else empty.
  std::string why_no_picture() const;
  /// The same of what it is compared with, of whatever size.
  HeldPicture picture_beside() const;
  std::string why_none_beside() const;
  /// picture_beside(), where the two have one size; else its owner is null.
  HeldPicture other_picture() const;
  /// Why the two cannot be held against each other: a sentence without a full stop; else empty.
  std::string why_not() const;
  /// Whether they are the two that are compared now; of the run's picture an earlier one will do.
  bool are_compared(const HeldPicture& picture, const HeldPicture& other) const;
  /// The newest map of differences that comparison() asked for; may be of an earlier snapshot. Null before the first.
  const std::shared_ptr<const ShownDifference>& difference() const { return difference_.newest(); }
  /// The newest quick metrics of the two, and those that a person sees (FLIP, IW-SSIM), which come when both pictures
  /// have stayed for a second. May be of an earlier snapshot. Null before the first, and where comparison() wants none.
  std::shared_ptr<const ShownMetrics> metrics() const { return fitting(metrics_); }
  std::shared_ptr<const ShownMetrics> all_metrics() const { return fitting(all_metrics_); }

  void carry_out(const command::Flip& c) { comparison_.flip = c.on; }
  void carry_out(const command::CompareWith& c);
  void carry_out(const command::ShowPicture& c) { comparison_.shown = pinned_.find(c.pin) ? c.pin : 0; }
  void carry_out(const command::Arrange& c) { comparison_.arrangement = c.arrangement; }
  void carry_out(const command::MoveSplit& c) { comparison_.split = c.to > 0 ? std::min(c.to, 1.0) : 0; }
  void carry_out(const command::ShowDifference& c);
  void carry_out(const command::ShowLayer& c) { comparison_.layer = c.layer; }
  void carry_out(const command::PinRun&);
  void carry_out(const command::PinFile& c);
  void carry_out(const command::ChangePin& c) { pinned_.change(c.pin, c.name, c.colour, c.shown); }
  void carry_out(const command::Unpin& c);
  /// Its id.
  std::uint64_t pin(PinnedRun run) { return pinned_.add(std::move(run)).id; }
  /// Whether pins are being read.
  bool reads_pins() const { return tasks_.busy(pins_); }
  /// The map is of another preset, whose run is shown.
  void forget() {
    difference_.forget(tasks_);
    comparison_.layer.clear();
    comparison_.shown = 0;
  }
  /// Once a frame: asks for the map and the metrics of what is shown now.
  void update(TaskQueue::Clock::time_point now);

private:
  /// A picture as one of the two: its pixels, its layers and what messages call it.
  struct Side {
    std::shared_ptr<const void> owner = {};
    int width = 0, height = 0;
    const std::vector<float>* rgb = nullptr;
    const std::vector<job::Layer>* layers = nullptr;
    std::string name = {};    ///< "the run"; of a file its path
    std::string subject = {}; ///< as a sentence begins: "the run's picture"
    std::string why_not = {}; ///< there is none
  };
  Side side_of(const PinnedRun& pin) const;
  std::shared_ptr<const job::Picture> run_picture() const;
  Side run_side() const;
  Side side() const;
  Side other_side() const;
  static HeldPicture held(const Side& side, const std::string& layer);
  static std::string why_no_layer(const Side& side, const std::string& layer);
  std::shared_ptr<const ShownMetrics> fitting(const NewestResult<ShownMetrics>& metrics) const;
  void update_map(TaskQueue::Clock::time_point now);
  void update_metrics(TaskQueue::Clock::time_point now);

  const RunInHand& run_;
  Services& services_;
  TaskQueue& tasks_; ///< of those
  TaskKey pins_;
  PinnedRuns pinned_;
  Comparison comparison_;
  NewestResult<ShownDifference> difference_;
  NewestResult<ShownMetrics> metrics_, all_metrics_;
  std::shared_ptr<const void> measured_, measured_against_; ///< the pictures that are measured now,
  TaskQueue::Clock::time_point measured_since_{};           ///< and since when they have stayed
};

} // namespace nephroid::ui
