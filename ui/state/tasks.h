// SPDX-License-Identifier: Apache-2.0
// What takes longer than a frame: work on threads of its own, beside the frames. The queue says what runs, cancels it,
// hands results over on the window's thread, and makes a message of what is thrown.
#pragma once
#include "ui/state/messages.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid::ui {

/// Whose tasks they are: those of one key run one after the other. Where it is gone, nothing is delivered any more.
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
  view,    ///< something to be seen: who draws it asks again while it is lacking, so nobody can cancel it
  request, ///< a person asked for it and can cancel it
  write    ///< of files that must be whole: nobody can cancel it, and the program ends after it
};

struct TaskAbout {
  std::string name; ///< what it does: "reading bunny.obj"
  TaskKind kind = TaskKind::view;
  bool replaces = false; ///< tasks of its key that have not begun are not needed any more
};

/// The work's own side of a task.
class TaskControl {
public:
  /// True: nobody waits for the result.
  bool cancelled() const { return cancelled_; }
  /// How much of it is done, 0..1.
  void progress(double part) { progress_ = part; }

private:
  friend class TaskQueue;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{-1};
};

struct TaskView {
  std::uint64_t id = 0;
  std::string name;
  double progress = -1; ///< 0..1; below 0: not known
  bool can_cancel = false;
};

/// For the window's thread alone; only the work runs elsewhere.
class TaskQueue {
public:
  using Clock = std::chrono::steady_clock;
  TaskQueue() = default;
  /// As finish(), without words.
  ~TaskQueue();
  TaskQueue(const TaskQueue&) = delete;
  TaskQueue& operator=(const TaskQueue&) = delete;

  /// work() or work(TaskControl&) on a thread of its own, after the tasks of this key that came before; deliver(result)
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
  /// Whether a task of this key runs or waits.
  bool busy(const TaskKey& key) const;
  /// Those of this key but writes are of no use any more, and keep no newer one waiting.
  void forget(const TaskKey& key);
  /// Takes no notice of a task that is not there or cannot be cancelled.
  void cancel(std::uint64_t id);
  /// Those that have run for this long.
  std::vector<TaskView> running(Clock::duration at_least = {}) const;
  bool empty() const { return tasks_.empty(); }
  /// Once a frame: delivers what is done. Whatever the work or the delivery throws becomes a message.
  void collect(Messages& messages);
  /// Waits until the tasks of this key are done and delivered.
  void wait(const TaskKey& key, Messages& messages);
  /// Before the end: waits for what is being written, and delivers nothing any more.
  void finish(Messages& messages);

private:
  using Delivery = std::function<void()>;
  using Step = std::function<Delivery(TaskControl&)>;
  struct Task {
    std::uint64_t id = 0;
    TaskAbout about;
    std::weak_ptr<const int> key;
    Step work; ///< until it begins
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

/// What is asked for, held against the newest result.
enum class Request { same, other_picture, other };

/// Something that is made again and again of what a panel shows: a difference of pictures, statistics of a region. Not
/// of every picture of a run, as that may be faster than it.
template <class Result>
class NewestResult {
public:
  using Clock = TaskQueue::Clock;
  using Make = std::function<std::shared_ptr<const Result>()>;

  /// Once a frame, returns at once: starts make() where the request is not the same and nothing is in the making. Where
  /// only the run's picture is another one it rests first, for twice the time that the last result took: the device may
  /// be the same processor.
  void want(TaskQueue& tasks, std::string name, Request request, Make make, Clock::time_point now) {
    if (request == Request::same || tasks.busy(key_) || (request == Request::other_picture && now < rest_until_))
      return;
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
  /// May be of an older request. Null before the first and after forget().
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
