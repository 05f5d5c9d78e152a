// SPDX-License-Identifier: Apache-2.0
// False-colour differences of two pictures, made beside the frames: FLIP of a large picture takes seconds, a frame 16 ms.
#pragma once
#include "measure/difference.h"
#include "ui/state/newest_result.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

/// A picture with whatever keeps its pixels alive.
struct HeldPicture {
  std::shared_ptr<const void> owner; ///< null: there is no picture
  measure::Pixels pixels;
};

struct DifferenceRequest {
  HeldPicture picture, other;
  measure::DifferenceMetric metric = measure::DifferenceMetric::lab;
  double scale = 0; ///< as Comparison::scale
};

struct ShownDifference {
  DifferenceRequest of;
  std::shared_ptr<const std::vector<float>> values; ///< a value a pixel; null where there is no map
  std::vector<unsigned char> rgba;                  ///< 4 a pixel
  double scale = 1;                                 ///< the value at the end of the colours
  std::string error;                                ///< why there is no map
};

using NewestDifference = NewestResult<ShownDifference>;
/// Once a frame: NewestResult::want().
void want_difference(NewestDifference& difference, TaskQueue& tasks, const DifferenceRequest& request,
                     NewestDifference::Clock::time_point now);

} // namespace nephroid::ui
