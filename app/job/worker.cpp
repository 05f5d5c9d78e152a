// SPDX-License-Identifier: Apache-2.0
// One thread, one mutex, one condition variable. The mutex guards only the commands and what readers copy; it is never
// held while a job works, so no reader ever waits for the device.
#include "job/worker.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

namespace nephroid::job {
namespace {

using Make = std::function<std::unique_ptr<Job>()>;
using Clock = std::chrono::steady_clock;

/// Longer than a frame of the window.
constexpr std::chrono::milliseconds adoption_linger{25};

/// After a snapshot the job works at least so many times as long as that took: large pictures may take longer than the
/// interval. In a job's first second each picture is much better than the one before: then half of that is enough, and
/// the interval is at most half the job's age.
constexpr int work_a_snapshot = 4;
constexpr std::chrono::seconds youth{1};

bool is_over(State state) {
  return state == State::idle || state == State::finished || state == State::cancelled || state == State::failed;
}

Error error_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& known) {
    return known;
  } catch (const std::bad_alloc&) {
    return failed("", "out of memory");
  } catch (const std::exception& other) {
    return failed("", other.what());
  } catch (...) {
    return failed("", "an unknown error");
  }
}

} // namespace

struct Worker::Impl {
  mutable std::mutex mutex;
  std::condition_variable changed; ///< a command came or the state changed
  // Commands
  Make next;                       ///< the newest start() that the thread has not taken yet
  std::uint64_t next_adoption = 0; ///< the newest adopt() before that
  struct Adoption {
    std::shared_ptr<const preset::Preset> preset;
    Make otherwise;
    std::uint64_t number = 0;
  };
  std::optional<Adoption> adoption; ///< the newest adopt() that the thread has not taken yet
  std::uint64_t adoptions = 0;      ///< how many there were
  bool cancelled = false, paused = false, ending = false;
  bool paused_since_adoption = false; ///< by a pause() after the newest adopt(): so begins what begins in its stead
  std::chrono::milliseconds interval{100};
  Observer nobody;
  Observer* observer = &nobody;
  bool has_job = false;                      ///< one that could adopt: in hand, or to come from `next`
  std::optional<std::array<int, 2>> watched; ///< the pixel of watch_spectrum()
  bool watch_changed = false;                ///< the thread has not told its spectrum yet
  // What readers see. status.generation is also a command: a job of another generation stops and says nothing more.
  Status status;
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<const PixelSpectrum> spectrum;

  // The thread's own
  std::uint64_t adopted = 0;       ///< the newest adoption that the job in hand knows of
  Clock::duration snapshot_took{}; ///< to make the newest one
  std::thread thread;

  bool must_stop(std::uint64_t generation) const { return cancelled || ending || status.generation != generation; }

  /// start() with the mutex held; number: of the newest adoption that make() knows of.
  void begin(Make make, std::uint64_t number) {
    next = std::move(make);
    next_adoption = number;
    adoption.reset();
    cancelled = paused = paused_since_adoption = false;
    has_job = true;
    Status preparing;
    preparing.state = State::preparing;
    preparing.generation = status.generation + 1;
    preparing.failures = status.failures;
    status = preparing;
    changed.notify_all();
  }

  /// With the mutex held, where the job in hand does not adopt. What was commanded after the adoption still holds.
  void begin_instead(const Adoption& refused) {
    if (cancelled || adoption) return; // a newer one is the job's to adopt
    const bool pause = paused_since_adoption;
    begin(refused.otherwise, refused.number);
    paused = paused_since_adoption = pause;
  }

  /// Calls change() with the mutex held, unless the job in hand was replaced: then the status is no longer about it.
  template <class Change>
  void update(std::uint64_t generation, Change change) {
    const std::lock_guard lock(mutex);
    if (status.generation != generation) return;
    change();
    changed.notify_all();
  }

  void set_state(std::uint64_t generation, State state) {
    update(generation, [&] {
      status.state = state;
      status.error.reset();
    });
  }

  void set_failed(std::uint64_t generation, const Error& error) {
    update(generation, [&] {
      status.state = State::failed;
      status.error = error;
      ++status.failures;
    });
  }

  void publish(std::uint64_t generation, Job& job) {
    const Clock::time_point begin = Clock::now();
    Snapshot made = job.snapshot();
    snapshot_took = Clock::now() - begin;
    made.adoption = adopted;
    auto shared = std::make_shared<const Snapshot>(
        std::move(made)); // the old one is freed after the lock: pictures are megabytes
    update(generation, [&] {
      std::swap(snapshot, shared);
      status.progress = snapshot->progress;
      // Together: a job that was finished and took on a preset is not finished with its first picture.
      if (!job.finished() && (status.state == State::finished || status.state == State::failed))
        status.state = State::running;
    });
    tell_spectrum(generation, job);
  }

  /// Makes the spectrum that is watched.
  void tell_spectrum(std::uint64_t generation, Job& job) {
    std::unique_lock lock(mutex);
    watch_changed = false;
    const auto pixel = watched;
    lock.unlock();
    auto* source = pixel ? dynamic_cast<SpectrumSource*>(&job) : nullptr;
    auto made = source ? source->spectrum(*pixel) : nullptr;
    update(generation, [&] {
      if (watched == pixel) spectrum.swap(made);
    });
  }

  enum class Move { step, adopt, tell, stop };

  /// What an unfinished job does next. Waits while paused, and a moment after an adoption: a step would delay the next.
  Move next_move(std::uint64_t generation, std::optional<Clock::time_point> adopted_at) {
    std::unique_lock lock(mutex);
    const auto commanded = [&] { return must_stop(generation) || adoption || watch_changed; };
    if (adopted_at) changed.wait_until(lock, *adopted_at + adoption_linger, commanded);
    for (; paused && !commanded(); changed.wait(lock))
      if (std::exchange(status.state, State::paused) != State::paused) changed.notify_all();
    if (must_stop(generation)) return Move::stop;
    if (adoption) return Move::adopt;
    if (watch_changed) return Move::tell;
    status.state = State::running;
    return Move::step;
  }

  /// What a finished job does next.
  Move last_move() const {
    const std::lock_guard lock(mutex);
    return adoption ? Move::adopt : watch_changed ? Move::tell : Move::stop;
  }

  /// Lets the job take on the newest preset, or makes a new one begin where it cannot. False where that failed: the job
  /// has to wait for the next adoption, and the state is failed unless that is there already.
  bool adopt_newest(std::uint64_t generation, Job& job) {
    std::unique_lock lock(mutex);
    const Adoption newest = *std::exchange(adoption, std::nullopt);
    lock.unlock();
    try {
      if (!job.adopt(*newest.preset)) {
        update(generation, [&] { begin_instead(newest); });
        return true;
      }
      adopted = newest.number;
      publish(generation, job);
      update(generation, [&] { status.error.reset(); });
      return true;
    } catch (...) {
      const Error error = error_of(std::current_exception());
      lock.lock();
      const bool is_overtaken = adoption.has_value(); // then nobody wants that preset any more
      lock.unlock();
      if (!is_overtaken) set_failed(generation, error);
      return false;
    }
  }

  /// Between a snapshot and the next of a job that has worked for so long, with the mutex held.
  Clock::duration pause_after_snapshot(Clock::duration age) const {
    if (age < youth) return std::max(std::min<Clock::duration>(interval, age / 2), work_a_snapshot / 2 * snapshot_took);
    return std::max<Clock::duration>(interval, work_a_snapshot * snapshot_took);
  }

  /// Steps the job until it is finished, has to stop or could not adopt, and shows its last state, which it returns.
  State advance(std::uint64_t generation, Job& job) {
    const Clock::time_point began = Clock::now();
    std::optional<Clock::time_point> shown, adopted_at;
    while (true) {
      const Move move = job.finished() ? last_move() : next_move(generation, std::exchange(adopted_at, std::nullopt));
      if (move == Move::stop) break;
      if (move == Move::tell) {
        tell_spectrum(generation, job);
        continue;
      }
      if (move == Move::adopt) {
        if (!adopt_newest(generation, job)) return State::failed;
        shown = adopted_at = Clock::now();
        continue;
      }
      job.advance();
      observer->advanced(job);
      Clock::time_point due = Clock::time_point::max(); // nobody waits for the picture of a job that was replaced
      update(generation, [&, progress = job.progress()] {
        status.progress = progress;
        due = shown ? *shown + pause_after_snapshot(Clock::now() - began) : Clock::time_point::min();
      });
      if (Clock::now() >= due) {
        publish(generation, job);
        shown = Clock::now();
      }
    }
    if (is_wanted(generation)) publish(generation, job);
    observer->ended(job);
    return job.finished() ? State::finished : State::cancelled;
  }

  /// False where nobody will look at the job again.
  bool is_wanted(std::uint64_t generation) const {
    const std::lock_guard lock(mutex);
    return !ending && status.generation == generation;
  }

  /// A finished job, or one that could not adopt, waits for the next adoption, and tells spectra. False: it has to go.
  bool wait_for_adoption(std::uint64_t generation, Job& job) {
    while (true) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return must_stop(generation) || adoption || watch_changed; });
      if (must_stop(generation)) return false;
      if (adoption) return true;
      lock.unlock();
      tell_spectrum(generation, job);
    }
  }

  void run_one(std::uint64_t generation, const Make& make) {
    const auto stopped = [&] {
      const std::lock_guard lock(mutex);
      return must_stop(generation);
    };
    try {
      const std::unique_ptr<Job> job = stopped() ? nullptr : make();
      if (!job || stopped())
        set_state(generation, State::cancelled);
      else {
        observer->begun(*job);
        do {
          const State state = advance(generation, *job);
          if (state != State::failed) set_state(generation, state);
        } while (wait_for_adoption(generation, *job));
      }
    } catch (...) {
      const Error error = error_of(std::current_exception());
      if (error.kind() == ErrorKind::interrupted && stopped())
        set_state(generation, State::cancelled);
      else
        set_failed(generation, error);
    }
    update(generation, [&] {
      has_job = false;
      if (!is_over(status.state))
        status.state = State::cancelled; // together with an adoption that had overtaken one that failed
      if (const auto left = std::exchange(adoption, std::nullopt)) begin_instead(*left);
    });
  }

  void loop() {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return ending || next; });
      if (ending) return;
      const Make make = std::exchange(next, nullptr);
      const std::uint64_t generation = status.generation;
      adopted = next_adoption;
      lock.unlock();
      run_one(generation, make);
      lock.lock();
    }
  }
};

Worker::Worker() : impl_(std::make_unique<Impl>()) {
  impl_->thread = std::thread([impl = impl_.get()] { impl->loop(); });
}

Worker::~Worker() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->ending = true;
    impl_->changed.notify_all();
  }
  impl_->thread.join();
}

std::shared_ptr<const Snapshot> Worker::start(std::function<std::unique_ptr<Job>()> make) {
  const std::lock_guard lock(impl_->mutex);
  impl_->begin(std::move(make), impl_->adoptions);
  return impl_->snapshot;
}

std::uint64_t Worker::adopt(std::shared_ptr<const preset::Preset> preset,
                            std::function<std::unique_ptr<Job>()> otherwise) {
  const std::lock_guard lock(impl_->mutex);
  const std::uint64_t number = ++impl_->adoptions;
  if (impl_->has_job && !impl_->cancelled) {
    impl_->adoption = Impl::Adoption{std::move(preset), std::move(otherwise), number};
    impl_->paused_since_adoption = false;
    impl_->changed.notify_all();
  } else
    impl_->begin(std::move(otherwise), number);
  return number;
}

void Worker::cancel() {
  const std::lock_guard lock(impl_->mutex);
  impl_->cancelled = true;
  impl_->changed.notify_all();
}

void Worker::pause(bool paused) {
  const std::lock_guard lock(impl_->mutex);
  impl_->paused = impl_->paused_since_adoption = paused;
  impl_->changed.notify_all();
}

Status Worker::status() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->status;
}

std::shared_ptr<const Snapshot> Worker::snapshot() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->snapshot;
}

void Worker::watch_spectrum(std::optional<std::array<int, 2>> pixel) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->watched == pixel) return;
  impl_->watched = pixel;
  impl_->watch_changed = true;
  if (!pixel) impl_->spectrum.reset();
  impl_->changed.notify_all();
}

std::shared_ptr<const PixelSpectrum> Worker::spectrum() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->spectrum;
}

void Worker::set_snapshot_interval(std::chrono::milliseconds interval) {
  const std::lock_guard lock(impl_->mutex);
  impl_->interval = interval;
}

void Worker::set_observer(Observer* observer) {
  const std::lock_guard lock(impl_->mutex);
  impl_->observer = observer;
}

void Worker::wait() {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock, [&] { return is_over(impl_->status.state); });
}

} // namespace nephroid::job
