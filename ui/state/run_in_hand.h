// SPDX-License-Identifier: Apache-2.0
// The run of the preset that is being edited: started, replaced or told of another light when the preset changes; its
// newest picture and what came with it. Never waits for a device.
#pragma once
#include "base/watch.h"
#include "compute/compute.h"
#include "job/worker.h"
#include "measure/measured_job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "ui/state/messages.h"
#include "ui/state/undo.h"

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

struct ViewedScene;
struct SeenByGlass;

/// What panels keep of a run's loaded scene; null where the preset has no such panel.
struct SceneFacts {
  std::shared_ptr<const ViewedScene> view;
  std::shared_ptr<const SeenByGlass> spectra;
};

struct NewRun {
  std::unique_ptr<job::Job> job;
  std::shared_ptr<const plan::Plan> plan;
  std::shared_ptr<const measure::Reference> reference; ///< what it is measured against; null where there is none
  SceneFacts scene_facts = {};
  compute::DeviceInfo device = {};  ///< that it works on
  std::optional<double> white = {}; ///< of the run, where the preset's is to be fitted
};

/// Where the workbench gets its runs from: the program gives ui/state/device_runs.h with a device, tests give jobs of
/// their own.
class RunSource {
public:
  virtual ~RunSource() = default;
  /// On the worker's thread only. What it throws is why the run failed, or interrupted where `watch` asks for it.
  virtual NewRun make(const preset::Preset& preset, const Watch& watch) = 0;
  /// From any thread, at once: the next make() reads every file anew; and opens the device anew, which a run may have
  /// lost.
  virtual void reread_files() {}
  virtual void reopen_device() {}
  /// From any thread, at once: true once after what every run is made of (the kernels) changed.
  virtual bool take_changed() = 0;
};

/// What a run is made of, and on what.
struct RunOrigin {
  std::shared_ptr<const preset::Preset> preset;
  std::shared_ptr<const plan::Plan> plan;
  std::shared_ptr<const measure::Reference> reference; ///< null where it is measured against none
  compute::DeviceInfo device;
};

class RunInHand {
public:
  /// Both outlive it. messages: where a failure is said, and taken back with the next start.
  RunInHand(RunSource& source, Messages& messages) : source_(source), messages_(messages) {}
  ~RunInHand() { preparing_.request_stop(); }

  /// Nothing of earlier runs is shown any more: another preset's picture would be mistaken for this one's.
  void forget();
  void start(const UndoStack& edits);
  /// Where only the light differs, the run in hand takes it on and goes on converging.
  void adopt_or_start(const UndoStack& edits);
  /// The same preset, but files that it names were changed.
  void start_with_new_files(const UndoStack& edits) {
    source_.reread_files();
    reads_anew_ = true;
    start(edits);
  }
  /// The preset was edited: the run follows with the next start_if_wanted(). live: the gesture still lasts.
  void follow_edit(bool live = false);
  void carry_out(const command::EndGesture&) { gesture_lasts_ = false; }
  void cancel();
  /// A run of another preset, called `name`, in place of the present one's: whatever edits and files ask for waits
  /// until take_back().
  void lend(std::shared_ptr<const preset::Preset> preset, std::string name);
  /// The run of the present preset starts again. edits: null where none is open.
  void take_back(const UndoStack* edits);
  void carry_out(const command::Pause& c) { worker_.pause(c.on); }
  /// As job::Worker's.
  void watch_spectrum(std::optional<std::array<int, 2>> pixel) { worker_.watch_spectrum(pixel); }
  /// Once a frame: takes the newest snapshot, and starts the run that edits ask for. edits: null before a preset is
  /// opened.
  void update(const UndoStack* edits);
  /// After edits: starts the run that they ask for, where it has not to wait for a picture of the one in hand.
  void start_if_wanted(const UndoStack& edits);

  const job::Status& status() const { return status_; }
  /// What its preparation is at, such as "reading bunny.obj", or that of the run before, which it waits for; empty
  /// where it does not prepare.
  std::string preparation() const;
  /// The newest picture there is, also of an earlier run until the present one has shown its first; null before the
  /// first of all.
  const std::shared_ptr<const job::Snapshot>& snapshot() const { return snapshot_; }
  /// Whether snapshot() is of the preset as it is now.
  bool snapshot_is_current() const { return snapshot_is_current_; }
  /// Whether snapshot() is of what came before the run in hand, which has shown nothing yet.
  bool snapshot_is_previous() const { return snapshot_ && (lent_ ? !shown_since_start_ : !snapshot_is_current_); }
  /// Of the pixel that is watched, as of snapshot() or a little newer; null where there is none.
  const std::shared_ptr<const job::PixelSpectrum>& spectrum() const { return spectrum_; }
  /// Of the run that snapshot() is of: "Ball lens: distance of the camera", the preset and the newest edit.
  const std::string& snapshot_name() const { return snapshot_name_; }
  /// What snapshot() was made of; nothing where that is null.
  const RunOrigin& snapshot_origin() const { return snapshot_origin_; }
  /// What the run's error was so far, of snapshot(); null where nothing is measured.
  std::shared_ptr<const job::History> error_history() const { return snapshot_ ? snapshot_->history : nullptr; }
  /// Of the newest run that was made ready; null before the first of a preset. Another plan is another object.
  const std::shared_ptr<const plan::Plan>& plan() const { return newest_.plan; }
  /// What that run is measured against; null where there is nothing.
  const std::shared_ptr<const measure::Reference>& reference() const { return newest_.reference; }
  /// The white that was fitted for the run of the present preset; nothing where that is still to come.
  std::optional<double> fitted_white() const {
    return preset_ && !lent_ && !restart_wanted_ ? preset_->white : std::nullopt;
  }
  /// Whether the preset of the run has a reference, which may still be on its way.
  bool has_reference() const { return preset_ && preset_->reference; }
  /// Of that run's scene; empty as plan(), and where the run's source takes none.
  const SceneFacts& scene_facts() const { return newest_.scene_facts; }

private:
  struct Arrival;
  /// Makes a run of the preset as it is now, on the worker's thread.
  std::function<std::unique_ptr<job::Job>()> maker();
  void take_over(const UndoStack& edits);
  bool loads_the_same() const;
  void begin();
  bool take_snapshot();
  bool is_worth_showing(const job::Snapshot& newest);
  void take_arrival();
  void report_failure();

  RunSource& source_;
  Messages& messages_;
  bool lent_ = false;              ///< to a preset that is not the present one
  bool restart_wanted_ = false;    ///< the preset changed since the last start
  bool kernels_changed_ = false;   ///< ... or the kernels
  bool reads_anew_ = false;        ///< ... or files that it names
  bool gesture_lasts_ = false;     ///< ... by a gesture that goes on
  bool shown_since_start_ = false; ///< a snapshot of the run in hand has come
  bool snapshot_is_current_ = false;
  std::optional<std::chrono::steady_clock::time_point>
      parts_since_;                              ///< the run in hand has had a picture, but not a whole one
  std::uint64_t reported_failure_ = 0;           ///< Status::failures when the newest one became a message
  std::uint64_t failure_message_ = 0;            ///< its message's id
  std::shared_ptr<const preset::Preset> preset_; ///< of the run in hand
  std::uint64_t adoption_ = 0; ///< of it by the run in hand: Snapshot::adoption of a picture of it is not less
  mutable std::mutex preparation_mutex_;
  std::string preparation_;    ///< as the worker's thread tells it
  std::stop_source preparing_; ///< ends the preparation of the run in hand
  job::Status status_;
  std::shared_ptr<const job::Snapshot> snapshot_, before_start_;
  std::shared_ptr<const job::PixelSpectrum> spectrum_;
  std::shared_ptr<Arrival> arrival_; ///< where the run in hand leaves what came with it
  NewRun newest_;                    ///< that was made ready, without its job, which the worker has
  RunOrigin snapshot_origin_;
  std::string name_, snapshot_name_;
  job::Worker worker_; ///< last: its thread uses the source
};

} // namespace nephroid::ui
