// SPDX-License-Identifier: Apache-2.0
// The plot of how well lights replace the map: irradiance error over how many there are, on logarithmic axes, by both methods.
#pragma once
#include "ui/environment/model.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

class QualityPlot {
public:
  /// In the window's free width; height in pixels.
  void draw(const ShownMap& shown, float height);
  const PlotArea& area() const { return area_; } ///< as drawn last, ends of the axes in lights and %; for tests

private:
  PlotArea area_;
};

/// Where something of each error is to be seen on a logarithmic axis: in %, from below the least that is above 0 to above the largest. A
/// decade below 10 % where there is none.
std::array<double, 2> error_range(const ShownMap& shown);

} // namespace nephroid::ui
