// SPDX-License-Identifier: Apache-2.0
// The worker thread: owns a job and, through it, the OpenCL queue. Others push commands and read the last snapshot.
#pragma once
#include "base/error.h"
#include "job/job.h"
#include "job/observer.h"

#include <chrono>
#include <optional>

namespace nephroid::job {

enum class State { idle, preparing, running, paused, finished, cancelled, failed };

/// What the worker is doing, readable at any time from any thread.
struct Status {
  State state = State::idle;
  Progress progress;
  std::optional<Error> error;   ///< where state is failed
  std::uint64_t generation = 0; ///< counts start() calls: which job this is about
  std::uint64_t failures = 0;   ///< how often the state became failed: which failure the error is about
};

class Worker {
public:
  Worker();
  ~Worker(); ///< cancels and joins
  /// Cancels what runs and starts over: make() runs on the worker thread (loading, kernels) and gives the job. Returns
  /// at once. An exception from make() or from a step becomes State::failed with its line. A pause ends. Returns the
  /// newest snapshot of the jobs before; null: none.
  std::shared_ptr<const Snapshot> start(std::function<std::unique_ptr<Job>()> make);
  /// Lets the job in hand take on a preset (Job::adopt) and shows its picture at once. A paused or finished job does so
  /// too: a finished job stays until the next start() or cancel(). A job that is being made does so when it is ready.
  /// Where there is no job, or it cannot, this is start(otherwise). What Job::adopt throws becomes State::failed, but
  /// the job stays for the next adopt(). Returns at once, with this adoption's number (Snapshot::adoption). Where
  /// several wait, only the newest is taken on, and one that a newer one overtakes while the job works at it starts and
  /// fails nothing. A cancel() or pause() that follows holds, whatever becomes of it.
  std::uint64_t adopt(std::shared_ptr<const preset::Preset> preset, std::function<std::unique_ptr<Job>()> otherwise);
  void cancel(); ///< after the slice in hand, or after make(), which may end early by throwing interrupted
  void pause(bool paused);
  Status status() const;
  /// The newest snapshot, null before the first ever: after start() the old job's stays until the new one's first.
  std::shared_ptr<const Snapshot> snapshot() const;
  /// From now on every snapshot comes with the spectrum of this pixel, where the job is a SpectrumSource; nothing: with
  /// none. A paused or finished job tells it too, as in adopt(). Stays for jobs to come. Returns at once.
  void watch_spectrum(std::optional<std::array<int, 2>> pixel);
  /// The newest one of the pixel that is watched; null where there is none.
  std::shared_ptr<const PixelSpectrum> spectrum() const;
  /// How often snapshots are made while running (default 100 ms; the first after the first step). They take at most a
  /// fifth of the time; in a job's first second, when they come sooner, a third.
  void set_snapshot_interval(std::chrono::milliseconds interval);
  /// Follows all jobs to come, to their ends, also where nobody will look at them again. It outlives the worker.
  void set_observer(Observer* observer);
  /// Blocks until the job is finished, cancelled or failed; for tests.
  void wait();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace nephroid::job
