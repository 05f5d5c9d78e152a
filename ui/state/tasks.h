// SPDX-License-Identifier: Apache-2.0
// Work that takes longer than a frame, on background threads. The queue lists what runs, cancels it, delivers results
// on the window's thread, and makes messages of errors. Services has it beside what else every part uses.
#pragma once
#include "ui/state/messages.h"

#include <atomic>
#include <future>
#include <type_traits>

namespace nephroid::ui {

/// Identifies the owner of tasks. Tasks of one key run one after the other. When the key is gone, nothing is delivered
/// any more.
class TaskKey {
public:
  TaskKey() = default;
  TaskKey(const TaskKey&) = delete;
  TaskKey& operator=(const TaskKey&) = delete;

private:
  friend class TaskQueue;
  std::shared_ptr<const int> alive_ = std::make_shared<const int>(0);
};

enum class TaskKind {
  view,    ///< something to be shown: its panel asks again until it is there, so nobody can cancel it
  request, ///< a person asked for it and can cancel it
  write    ///< files that must be whole: nobody can cancel it, and the program ends after it
};

struct TaskAbout {
  std::string name; ///< what the task does: "reading bunny.obj"
  TaskKind kind = TaskKind::view;
  bool replaces = false; ///< drops the tasks of its key that have not begun
};

class TaskControl {
public:
  /// True: the result is not needed any more.
  bool cancelled() const { return cancelled_; }
  /// Says which part is finished, 0..1.
  void progress(double part) { progress_ = part; }

private:
  friend class TaskQueue;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{-1};
};

struct TaskView {
  std::uint64_t id = 0;
  std::string name;
  double progress = -1; ///< 0..1; below 0: unknown
  bool can_cancel = false;
};

/// Used on the window's thread alone; only the work runs elsewhere.
class TaskQueue {
public:
  using Clock = std::chrono::steady_clock;
  TaskQueue() = default;
  /// Does what finish() does, without messages.
  ~TaskQueue();
  TaskQueue(const TaskQueue&) = delete;
  TaskQueue& operator=(const TaskQueue&) = delete;

  /// Runs work() or work(TaskControl&) on a background thread, after the earlier tasks of this key, and deliver(result)
  /// in collect(). The work must own or share whatever it uses: the key's owner may end before it.
  template <class Work, class Deliver>
  void start(const TaskKey& key, TaskAbout about, Work work, Deliver deliver) {
    add(key, std::move(about),
        [work = std::move(work), deliver = std::move(deliver)](TaskControl& control) -> Delivery {
          const auto call = [&] {
            if constexpr (std::is_invocable_v<const Work&, TaskControl&>)
              return work(control);
            else
              return work();
          };
          using Result = decltype(call());
          if constexpr (std::is_void_v<Result>) {
            call();
            return deliver;
          } else {
            auto result = std::make_shared<Result>(call());
            return [deliver, result] { deliver(std::move(*result)); };
          }
        });
  }
  bool busy(const TaskKey& key) const;
  /// Drops the tasks of this key except writes; newer ones need not wait for them.
  void forget(const TaskKey& key);
  /// Ignores a task that does not exist or cannot be cancelled.
  void cancel(std::uint64_t id);
  /// The tasks that have run for at least this long.
  std::vector<TaskView> running(Clock::duration at_least = {}) const;
  bool empty() const { return tasks_.empty(); }
  /// Called once a frame: delivers results. Errors of the work or of the delivery become messages.
  void collect(Messages& messages);
  /// Waits until the tasks of this key are done and delivered.
  void wait(const TaskKey& key, Messages& messages);
  /// Called before the end: waits for files that are being written, and delivers nothing any more.
  void finish(Messages& messages);

private:
  using Delivery = std::function<void()>;
  using Step = std::function<Delivery(TaskControl&)>;
  struct Task {
    std::uint64_t id = 0;
    TaskAbout about;
    std::weak_ptr<const int> key;
    Step work; ///< empty once it has begun
    std::shared_ptr<TaskControl> control = std::make_shared<TaskControl>();
    std::future<Delivery> delivery; ///< valid once it has begun
    Clock::time_point begun{};
  };
  using TaskPtr = std::shared_ptr<Task>;
  void add(const TaskKey& key, TaskAbout about, Step work);
  static bool is_of(const Task& task, const TaskKey& key);
  bool holds_up(const Task& earlier, const Task& task) const;
  void begin_waiting();
  void end(const TaskPtr& task, Messages& messages);
  void drop(const std::function<bool(const Task&)>& which);

  std::vector<TaskPtr> tasks_; ///< in the order of start()
  std::uint64_t last_id_ = 0;
  bool finishing_ = false;
};

/// What every part of the workbench uses.
struct Services {
  Messages messages;
  TaskQueue tasks;
  Commands follow_ups; ///< commands that a command or a finished task leads to; carried out next
};

/// Something that a panel shows and that is made again and again: a difference of pictures, statistics of a region. A
/// run's pictures may come faster than it is made, so it is not made for each.
template <class Result>
class NewestResult {
public:
  using Clock = TaskQueue::Clock;
  using Make = std::function<std::shared_ptr<const Result>()>;

  /// Called once a frame, returns at once: starts make() where the request differs from the newest result's and nothing
  /// is being made. Where only the picture differs (fits, and not same_picture) it waits first, for twice the time of
  /// the last result, because the device may be the same processor.
  void want(TaskQueue& tasks, std::string name, bool fits, bool same_picture, Make make, Clock::time_point now) {
    if ((fits && (same_picture || now < rest_until_)) || tasks.busy(key_)) return;
    const auto timed = [make = std::move(make)] {
      const Clock::time_point begin = Clock::now();
      auto result = make();
      return std::pair(std::move(result), Clock::now() - begin);
    };
    tasks.start(key_, {std::move(name)}, timed, [this](auto result_and_time) {
      newest_ = std::move(result_and_time.first);
      rest_until_ = Clock::now() + 2 * result_and_time.second;
    });
  }
  /// The newest result, perhaps of an older request. Null before the first and after forget().
  const std::shared_ptr<const Result>& newest() const { return newest_; }
  void forget(TaskQueue& tasks) {
    newest_.reset();
    tasks.forget(key_);
  }

private:
  TaskKey key_;
  std::shared_ptr<const Result> newest_;
  Clock::time_point rest_until_{};
};

} // namespace nephroid::ui
