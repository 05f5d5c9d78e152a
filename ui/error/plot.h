// SPDX-License-Identifier: Apache-2.0
// The plot of error against time on two log axes: lines of several runs, noise floor, target, and the values under the cursor.
#pragma once
#include "ui/error/lines.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

struct PlottedRun {
  std::string name;
  std::uint32_t colour = 0;        ///< IM_COL32
  float weight = 1.5f;             ///< of its line, in pixels at scale 1
  const RunLines* lines = nullptr; ///< outlives the call
};

struct PlotContents {
  std::string metric;
  std::vector<PlottedRun> runs; ///< the one in front last
  std::optional<double> target;
};

class ErrorPlot {
public:
  /// In the window's free width; height in pixels.
  void draw(const PlotContents& contents, float height);
  /// The axes show everything and grow with the run: from the start, until somebody zooms or moves them.
  bool follows() const { return follows_; }
  void follow() { follows_ = true; }
  /// Where the plot's area was drawn last, and the ends of its axes; for tests.
  const std::array<double, 4>& area() const { return area_.screen; } ///< x, y, width, height
  PlotRange shown() const { return {area_.x, area_.y}; }

private:
  bool follows_ = true;
  PlotArea area_;
};

} // namespace nephroid::ui
