// SPDX-License-Identifier: Apache-2.0
// False-colour differences of two pictures, made on a thread of their own: FLIP of a large picture takes seconds, a frame 16 ms.
#pragma once
#include "measure/difference.h"
#include "ui/state/background_maker.h"

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

class DifferenceMaker {
public:
  using Clock = BackgroundMaker<ShownDifference>::Clock;
  /// Once a frame, returns at once: starts what is wanted where it is not what newest() shows or is in the making. Where only the
  /// run's picture changed it rests first.
  void want(const DifferenceRequest& request, Clock::time_point now);
  /// The newest map; may be of an older request. Null before the first and after forget().
  const std::shared_ptr<const ShownDifference>& newest() const { return maker_.newest(); }
  void forget() { maker_.forget(); }

private:
  BackgroundMaker<ShownDifference> maker_;
};

} // namespace nephroid::ui
