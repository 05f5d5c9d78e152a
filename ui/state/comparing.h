// SPDX-License-Identifier: Apache-2.0
// Compares two pictures. The first is the run in hand, or a pinned run or opened picture in its place; the second is
// another of these or the reference. Their map of differences in false colour and their metrics are made in the
// background: FLIP of a large picture takes seconds, a frame 16 ms.
#pragma once
#include "measure/difference.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_in_hand.h"
#include "ui/state/tasks.h"

#include <algorithm>

namespace nephroid::ui {

/// A picture with the owner of its pixels.
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
  std::shared_ptr<const std::vector<float>> values; ///< a value per pixel; null where there is no map
  std::vector<unsigned char> rgba;                  ///< 4 bytes per pixel
  double scale = 1;                                 ///< the value at the end of the colours
  std::string error;                                ///< why there is no map
};

struct ShownMetrics {
  HeldPicture picture, other;
  measure::Metrics metrics;
  std::string error; ///< why there are none, in one line
};

class Comparing {
public:
  /// run and services outlive the object.
  Comparing(const RunInHand& run, Services& services) : run_(run), services_(services), tasks_(services.tasks) {}

  const PinnedRuns& pinned() const { return pinned_; }
  const Comparison& comparison() const { return comparison_; }
  bool shows_run_alone() const {
    const Comparison& c = comparison_;
    return c.shown == 0 && c.arrangement == Arrangement::single && !c.flip && !c.difference;
  }
  /// The shown picture with all its layers: the run's, or that of the pinned run or opened picture that comparison()
  /// names. Null: none yet.
  std::shared_ptr<const job::Picture> source() const;
  /// "this run", or the quoted name of the pinned run or picture. other_name() may also be "Reference".
  std::string name() const;
  std::string other_name() const;
  /// source(), or the layer of it that comparison() names. Its owner is null where why_no_picture() is not empty.
  HeldPicture picture() const;
  /// Why there is no such picture: a sentence without a full stop; empty where there is one.
  std::string why_no_picture() const;
  /// The picture that it is compared with, of any size, and why there is none.
  HeldPicture picture_beside() const;
  std::string why_none_beside() const;
  /// picture_beside() where both have the same size; else its owner is null.
  HeldPicture other_picture() const;
  /// Why the two cannot be compared: a sentence without a full stop; empty where they can.
  std::string why_not() const;
  /// Whether these two are compared now. An earlier picture of the run counts too.
  bool are_compared(const HeldPicture& picture, const HeldPicture& other) const;
  /// The newest map of differences that comparison() asked for, perhaps of an earlier snapshot. Null before the first.
  const std::shared_ptr<const ShownDifference>& difference() const { return difference_.newest(); }
  /// The newest metrics of the two. The perceptual ones (FLIP, IW-SSIM) follow when both pictures have stayed for a
  /// second. They may be of an earlier snapshot. Null before the first, and where comparison() wants none.
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
  /// Returns the pin's id.
  std::uint64_t pin(PinnedRun run) { return pinned_.add(std::move(run)).id; }
  bool reads_pins() const { return tasks_.busy(pins_); }
  /// Drops the map of another preset, whose run is shown.
  void forget() {
    difference_.forget(tasks_);
    comparison_.layer.clear();
    comparison_.shown = 0;
  }
  /// Called once a frame: asks for the map and the metrics of what is shown now.
  void update(TaskQueue::Clock::time_point now);

private:
  struct Side {
    std::shared_ptr<const void> owner = {};
    int width = 0, height = 0;
    const std::vector<float>* rgb = nullptr;
    const std::vector<job::Layer>* layers = nullptr;
    std::string name = {};    ///< "the run", or a file's path
    std::string subject = {}; ///< the subject of a sentence: "the run's picture"
    std::string why_not = {}; ///< why there is no picture
  };
  template <class Picture>
  static Side side_of(const Picture& picture, const std::string& name, const std::string& subject);
  static Side pinned_side(const PinnedRun& pin);
  std::shared_ptr<const job::Picture> run_picture() const;
  Side run_side() const;
  Side side() const;
  Side other_side() const;
  HeldPicture held(const Side& side) const;
  std::string why_no_layer(const Side& side) const;
  std::shared_ptr<const ShownMetrics> fitting(const NewestResult<ShownMetrics>& metrics) const;
  void update_map(TaskQueue::Clock::time_point now);
  void update_metrics(TaskQueue::Clock::time_point now);

  const RunInHand& run_;
  Services& services_;
  TaskQueue& tasks_; ///< services_.tasks
  TaskKey pins_;
  PinnedRuns pinned_;
  Comparison comparison_;
  NewestResult<ShownDifference> difference_;
  NewestResult<ShownMetrics> metrics_, all_metrics_;
  std::shared_ptr<const void> measured_, measured_against_; ///< the pictures that are measured now
  TaskQueue::Clock::time_point measured_since_{};           ///< since when both have stayed
};

} // namespace nephroid::ui
