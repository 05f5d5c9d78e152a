// SPDX-License-Identifier: Apache-2.0
// Statistics made on a thread of their own: medians of a large picture take a tenth of a second, a frame 16 ms.
#pragma once
#include "ui/inspector/region.h"
#include "ui/state/background_maker.h"

#include <memory>

namespace nephroid::ui {

class RegionMaker {
public:
  using Clock = BackgroundMaker<RegionStatistics>::Clock;
  /// Once a frame, returns at once: starts what is wanted where it is neither newest() nor in the making. Where only the run's picture
  /// changed it rests first. The region reaches into the picture.
  void want(const RegionRequest& request, Clock::time_point now = Clock::now());
  /// May be of an older request. Null before the first and after forget().
  const std::shared_ptr<const RegionStatistics>& newest() const { return maker_.newest(); }
  void forget() { maker_.forget(); }

private:
  BackgroundMaker<RegionStatistics> maker_;
};

} // namespace nephroid::ui
