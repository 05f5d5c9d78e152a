// SPDX-License-Identifier: Apache-2.0
// The run of the preset in hand, with its newest picture and its facts. When the preset changes, the run starts again
// or adopts another light. Never waits for a device.
#pragma once
#include "base/watch.h"
#include "compute/compute.h"
#include "job/worker.h"
#include "measure/measured_job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "ui/state/messages.h"
#include "ui/state/undo.h"

#include <mutex>

namespace nephroid::ui {

struct ViewedScene;
struct SeenByGlass;

/// What panels keep of a run's loaded scene. A member is null where no panel of the preset needs it.
struct SceneFacts {
  std::shared_ptr<const ViewedScene> view;
  std::shared_ptr<const SeenByGlass> spectra;
};

struct NewRun {
  std::unique_ptr<job::Job> job;
  std::shared_ptr<const plan::Plan> plan;
  std::shared_ptr<const measure::Reference> reference; ///< null where there is none
  SceneFacts scene_facts = {};
  compute::DeviceInfo device = {};  ///< the run's device
  std::optional<double> white = {}; ///< the run's white, where the preset's is to be fitted
};

/// Makes the workbench's runs: the program uses ui/state/device_runs.h with a device, tests their own jobs.
class RunSource {
public:
  virtual ~RunSource() = default;
  /// Called on the worker's thread only. What it throws is why the run failed; interrupted where `watch` asks for it.
  virtual NewRun make(const preset::Preset& preset, const Watch& watch) = 0;
  /// Makes the job of a small picture that goes beside the runs. Called on one thread only, which is another one than
  /// make()'s and may be here at the same time. Throws as make().
  virtual std::unique_ptr<job::Job> make_beside(const preset::Preset& preset, const Watch& watch) = 0;
  /// Opens the device for a film, once more beside the runs; it may be called when this is gone.
  virtual std::function<compute::Context()> device_opener() const = 0;
  /// Both return at once, from any thread. The next make() then reads every file again, or opens the device again,
  /// which a run may have lost.
  virtual void reread_files() {}
  virtual void reopen_device() {}
  /// Returns at once, from any thread: whether somebody looks at what the preset's meters show. Then they have half of
  /// the runs' time, else run::usual_meter_share.
  virtual void look_at_meters(bool) {}
  /// Returns at once, from any thread: true once after the kernels, which all runs use, have changed.
  virtual bool take_changed() = 0;
};

struct RunOrigin {
  std::shared_ptr<const preset::Preset> preset;
  std::shared_ptr<const plan::Plan> plan;
  std::shared_ptr<const measure::Reference> reference; ///< null where there is none
  compute::DeviceInfo device;
};

class RunInHand {
public:
  /// source and messages outlive the object. A failure becomes a message, which the next start removes.
  RunInHand(RunSource& source, Messages& messages) : source_(source), messages_(messages) {}
  ~RunInHand() { preparing_.request_stop(); }

  /// Drops all that earlier runs have shown: another preset's picture would be mistaken for this one's.
  void forget();
  void start(const UndoStack& edits);
  /// Where only the light differs, the run in hand adopts it and goes on converging. Where only `display` differs,
  /// nothing is computed (both).
  void adopt_or_start(const UndoStack& edits);
  /// Starts again with the same preset: files that it names have changed.
  void start_with_new_files(const UndoStack& edits) {
    source_.reread_files();
    reads_anew_ = true;
    ++readings_;
    start(edits);
  }
  /// Counts how often files or kernels have changed.
  std::uint64_t readings() const { return readings_; }
  /// Notes an edit; the run follows at the next start_if_wanted(). live: the gesture still lasts.
  void follow_edit(const UndoStack& edits, bool live = false);
  void carry_out(const command::EndGesture&) { gesture_lasts_ = false; }
  void cancel();
  /// Runs another preset, called `name`, in place of the present one. Runs that edits and files ask for wait until
  /// take_back().
  void lend(std::shared_ptr<const preset::Preset> preset, std::string name);
  /// Starts the present preset's run again. edits: null where none is open.
  void take_back(const UndoStack* edits);
  void carry_out(const command::Pause& c) { worker_.pause(c.on); }
  /// As job::Worker::watch_spectrum.
  void watch_spectrum(std::optional<std::array<int, 2>> pixel) { worker_.watch_spectrum(pixel); }
  /// As RunSource::look_at_meters.
  void look_at_meters(bool on) { source_.look_at_meters(on); }
  /// Called once a frame: takes the newest snapshot and starts the run that edits ask for. edits: null before a preset
  /// is opened.
  void update(const UndoStack* edits);
  /// Starts the run that edits ask for, unless it must wait for a picture of the one in hand.
  void start_if_wanted(const UndoStack& edits);

  const job::Status& status() const { return status_; }
  /// What the preparation is doing, such as "reading bunny.obj"; that of the run before while the new one waits for it.
  /// Empty where nothing is prepared.
  std::string preparation() const;
  /// The newest picture, which is an earlier run's until the present one has shown its first; null before the first of
  /// all.
  const std::shared_ptr<const job::Snapshot>& snapshot() const { return snapshot_; }
  bool snapshot_is_current() const { return snapshot_is_current_; }
  /// Whether snapshot() is older than the run in hand, which has shown nothing yet.
  bool snapshot_is_previous() const { return snapshot_ && (lent_ ? !shown_since_start_ : !snapshot_is_current_); }
  /// The spectrum of the watched pixel, as of snapshot() or a little newer; null where there is none.
  const std::shared_ptr<const job::PixelSpectrum>& spectrum() const { return spectrum_; }
  /// What is wrong with how bright its picture is, after the first pass; else empty.
  const std::string& exposure() const { return exposure_; }
  /// The name of the run behind snapshot(): "Ball lens: distance of the camera", the preset and the newest edit.
  const std::string& snapshot_name() const { return snapshot_name_; }
  /// The inputs of snapshot(); nothing where that is null.
  const RunOrigin& snapshot_origin() const { return snapshot_origin_; }
  /// The history of the error up to snapshot(); null where nothing is measured.
  std::shared_ptr<const job::History> error_history() const { return snapshot_ ? snapshot_->history : nullptr; }
  /// The plan of the newest prepared run; null before the first of a preset. Another plan is another object.
  const std::shared_ptr<const plan::Plan>& plan() const { return newest_.plan; }
  /// That run's reference; null where there is none.
  const std::shared_ptr<const measure::Reference>& reference() const { return newest_.reference; }
  /// The white that was fitted for the present preset's run; nothing before that.
  std::optional<double> fitted_white() const {
    return preset_ && !lent_ && !restart_wanted_ ? preset_->white : std::nullopt;
  }
  /// Whether the run's preset has a reference, which may still be loading.
  bool has_reference() const { return preset_ && preset_->reference; }
  /// The facts of that run's scene; empty as plan(), and where the source provides none.
  const SceneFacts& scene_facts() const { return newest_.scene_facts; }

private:
  struct Arrival;
  /// Returns what makes a run of the present preset on the worker's thread.
  std::function<std::unique_ptr<job::Job>()> maker();
  void take_over(const UndoStack& edits);
  bool take_same_light(const preset::Preset& now);
  bool loads_the_same() const;
  void begin();
  bool take_snapshot();
  bool is_worth_showing(const job::Snapshot& newest);
  void take_arrival();
  void report_failure();

  RunSource& source_;
  Messages& messages_;
  bool lent_ = false;            ///< the run is of a preset other than the present one
  bool restart_wanted_ = false;  ///< the preset changed since the last start
  bool kernels_changed_ = false; ///< the kernels changed since the last start
  std::uint64_t readings_ = 0;
  bool reads_anew_ = false;        ///< files that the preset names changed since the last start
  bool gesture_lasts_ = false;     ///< the gesture of the newest edit still lasts
  bool shown_since_start_ = false; ///< a snapshot of the run in hand has come
  bool snapshot_is_current_ = false;
  /// When the run in hand first had a picture, though not a whole one.
  std::optional<std::chrono::steady_clock::time_point> parts_since_;
  std::uint64_t reported_failure_ = 0;           ///< Status::failures when the newest failure became a message
  std::uint64_t failure_message_ = 0;            ///< its message's id
  std::shared_ptr<const preset::Preset> preset_; ///< the run in hand's
  std::uint64_t adoption_ = 0;                   ///< pictures of preset_ have at least this Snapshot::adoption
  mutable std::mutex preparation_mutex_;
  std::string preparation_;    ///< as the worker's thread reports it
  std::stop_source preparing_; ///< ends the preparation of the run in hand
  job::Status status_;
  std::shared_ptr<const job::Snapshot> snapshot_, before_start_;
  std::shared_ptr<const job::PixelSpectrum> spectrum_;
  std::shared_ptr<Arrival> arrival_; ///< where the run in hand leaves its facts
  NewRun newest_;                    ///< the newest prepared run, without its job, which the worker has
  RunOrigin snapshot_origin_;
  std::string name_, snapshot_name_, exposure_;
  job::Worker worker_; ///< last: its thread uses the source
};

} // namespace nephroid::ui
