// SPDX-License-Identifier: Apache-2.0
// Something that is made again and again of what a panel shows: a difference of pictures, statistics of a region. Not of every picture of a
// run, as that may be faster than it.
#pragma once
#include "ui/state/tasks.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace nephroid::ui {

/// What is asked for, held against the newest result.
enum class Request { same, other_picture, other };

template <class Result>
class NewestResult {
public:
  using Clock = TaskQueue::Clock;
  using Make = std::function<std::shared_ptr<const Result>()>;

  /// Once a frame, returns at once: starts make() where the request is not the same and nothing is in the making. Where only the run's
  /// picture is another one it rests first, for twice the time that the last result took: the device may be the same processor.
  void want(TaskQueue& tasks, std::string name, Request request, Make make, Clock::time_point now)
  {
    if (request == Request::same || tasks.busy(key_) || (request == Request::other_picture && now < rest_until_)) return;
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
  void forget(TaskQueue& tasks)
  {
    newest_.reset();
    tasks.forget(key_);
  }

private:
  TaskKey key_;
  std::shared_ptr<const Result> newest_;
  Clock::time_point rest_until_{};
};

} // namespace nephroid::ui
