// SPDX-License-Identifier: Apache-2.0
// Statistics made on a thread of their own: medians of a large picture take a tenth of a second, a frame 16 ms.
#pragma once
#include "ui/inspector/region.h"

#include <chrono>
#include <future>
#include <memory>

namespace nephroid::ui {

class RegionMaker {
public:
  using Clock = std::chrono::steady_clock;
  /// Once a frame, returns at once: starts what is wanted where it is neither newest() nor in the making. Where only the run's picture
  /// changed it rests for twice the time that the last one took: the device may be the same processor. The region reaches into the picture.
  void want(const RegionRequest& request, Clock::time_point now = Clock::now());
  /// May be of an older request. Null before the first and after forget().
  const std::shared_ptr<const RegionStatistics>& newest() const { return newest_; }
  void forget();

private:
  struct Made {
    std::shared_ptr<const RegionStatistics> statistics;
    Clock::duration took{};
  };

  std::shared_ptr<const RegionStatistics> newest_;
  Clock::time_point rest_until_{};
  bool forgotten_ = false; ///< what is in the making is no longer wanted
  std::future<Made> made_;
};

} // namespace nephroid::ui
