// SPDX-License-Identifier: Apache-2.0
// One thread, one mutex, one condition variable. The mutex guards only the commands and what readers copy; it is never held
// while a job works, so no reader ever waits for the device.
#include "job/worker.h"

#include "base/error.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

namespace nephroid::job {
namespace {

using Make = std::function<std::unique_ptr<Job>()>;
using Clock = std::chrono::steady_clock;

bool is_over(State state)
{
  return state == State::idle || state == State::finished || state == State::cancelled || state == State::failed;
}

Error error_of(const std::exception_ptr& error)
{
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
  Make next; ///< the newest start() that the thread has not taken yet
  bool cancelled = false, paused = false, ending = false;
  std::chrono::milliseconds interval{100};
  // What readers see. status.generation is also a command: a job of another generation stops and says nothing more.
  Status status;
  std::shared_ptr<const Snapshot> snapshot;

  std::thread thread;

  bool must_stop(std::uint64_t generation) const { return cancelled || ending || status.generation != generation; }

  /// Calls change() with the mutex held, unless the job in hand was replaced: then the status is no longer about it.
  template <class Change>
  void update(std::uint64_t generation, Change change)
  {
    const std::lock_guard lock(mutex);
    if (status.generation != generation) return;
    change();
    changed.notify_all();
  }

  void set_state(std::uint64_t generation, State state)
  {
    update(generation, [&] { status.state = state; });
  }

  void set_failed(std::uint64_t generation, const Error& error)
  {
    update(generation, [&] {
      status.state = State::failed;
      status.message = error.line();
      status.error_kind = error.kind();
    });
  }

  void publish(std::uint64_t generation, Snapshot&& made)
  {
    auto shared = std::make_shared<const Snapshot>(std::move(made)); // the old one is freed after the lock: pictures are megabytes
    update(generation, [&] {
      std::swap(snapshot, shared);
      status.progress = snapshot->progress;
    });
  }

  /// Waits while paused. False when the job has to stop.
  bool may_step(std::uint64_t generation)
  {
    std::unique_lock lock(mutex);
    for (; paused && !must_stop(generation); changed.wait(lock))
      if (std::exchange(status.state, State::paused) != State::paused) changed.notify_all();
    if (must_stop(generation)) return false;
    status.state = State::running;
    return true;
  }

  /// Steps the job until it is finished or has to stop; its last state is shown either way.
  void advance(std::uint64_t generation, Job& job)
  {
    std::optional<Clock::time_point> shown;
    while (!job.finished() && may_step(generation)) {
      job.step();
      std::chrono::milliseconds wait{};
      update(generation, [&, progress = job.progress()] {
        status.progress = progress;
        wait = interval;
      });
      if (!shown || Clock::now() - *shown >= wait) {
        publish(generation, job.snapshot());
        shown = Clock::now();
      }
    }
    if (is_wanted(generation)) publish(generation, job.snapshot());
  }

  /// False where nobody will look at the job again.
  bool is_wanted(std::uint64_t generation) const
  {
    const std::lock_guard lock(mutex);
    return !ending && status.generation == generation;
  }

  void run_one(std::uint64_t generation, const Make& make)
  {
    const auto stopped = [&] {
      const std::lock_guard lock(mutex);
      return must_stop(generation);
    };
    try {
      const std::unique_ptr<Job> job = stopped() ? nullptr : make();
      if (job && !stopped()) advance(generation, *job);
      set_state(generation, job && job->finished() ? State::finished : State::cancelled);
    } catch (...) {
      set_failed(generation, error_of(std::current_exception()));
    }
  }

  void loop()
  {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return ending || next; });
      if (ending) return;
      const Make make = std::exchange(next, nullptr);
      const std::uint64_t generation = status.generation;
      lock.unlock();
      run_one(generation, make);
      lock.lock();
    }
  }
};

Worker::Worker() : impl_(std::make_unique<Impl>())
{
  impl_->thread = std::thread([impl = impl_.get()] { impl->loop(); });
}

Worker::~Worker()
{
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->ending = true;
    impl_->changed.notify_all();
  }
  impl_->thread.join();
}

void Worker::start(std::function<std::unique_ptr<Job>()> make)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->next = std::move(make);
  impl_->cancelled = impl_->paused = false;
  Status preparing;
  preparing.state = State::preparing;
  preparing.generation = impl_->status.generation + 1;
  impl_->status = preparing;
  impl_->changed.notify_all();
}

void Worker::cancel()
{
  const std::lock_guard lock(impl_->mutex);
  impl_->cancelled = true;
  impl_->changed.notify_all();
}

void Worker::pause(bool paused)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->paused = paused;
  impl_->changed.notify_all();
}

Status Worker::status() const
{
  const std::lock_guard lock(impl_->mutex);
  return impl_->status;
}

std::shared_ptr<const Snapshot> Worker::snapshot() const
{
  const std::lock_guard lock(impl_->mutex);
  return impl_->snapshot;
}

void Worker::set_snapshot_interval(std::chrono::milliseconds interval)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->interval = interval;
}

void Worker::wait()
{
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock, [&] { return is_over(impl_->status.state); });
}

} // namespace nephroid::job
