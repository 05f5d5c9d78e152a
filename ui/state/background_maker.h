// SPDX-License-Identifier: Apache-2.0
// Something that a frame has no time for, made of the newest request on a thread of its own: a difference of pictures, statistics of a
// region.
#pragma once
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>

namespace nephroid::ui {

template <class Result>
class BackgroundMaker {
public:
  using Clock = std::chrono::steady_clock;

  /// Once a frame, returns at once: takes over what is made. Whether nothing is in the making, so that start() may be called.
  bool idle(Clock::time_point now)
  {
    if (!made_.valid()) return true;
    if (made_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Made made = made_.get();
    rest_until_ = now + 2 * made.took;
    if (!std::exchange(forgotten_, false)) newest_ = std::move(made.result);
    return true;
  }
  /// For twice the time that the last result took: the device may be the same processor.
  bool rests(Clock::time_point now) const { return now < rest_until_; }
  void start(std::function<std::shared_ptr<const Result>()> make)
  {
    made_ = std::async(std::launch::async, [make = std::move(make)] {
      const Clock::time_point begin = Clock::now();
      Made made{make(), {}};
      made.took = Clock::now() - begin;
      return made;
    });
  }
  /// May be of an older request. Null before the first and after forget().
  const std::shared_ptr<const Result>& newest() const { return newest_; }
  void forget()
  {
    newest_.reset();
    forgotten_ = made_.valid();
  }

private:
  struct Made {
    std::shared_ptr<const Result> result;
    Clock::duration took{};
  };

  std::shared_ptr<const Result> newest_;
  Clock::time_point rest_until_{};
  bool forgotten_ = false; ///< what is in the making is no longer wanted
  std::future<Made> made_;
};

} // namespace nephroid::ui
