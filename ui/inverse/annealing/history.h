// SPDX-License-Identifier: Apache-2.0
// The curves of a run (job::Curve) as lines, and the plot of one over sweeps, moves or seconds: the cost, and whatever else an engine notes
// about its search.
#pragma once
#include "job/job.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

struct HistoryLine {
  std::string name; ///< its column
  std::vector<double> x, y;
};

struct HistoryLines {
  std::string name; ///< of the curve
  std::string x;    ///< the column that the lines are drawn over
  std::vector<HistoryLine> lines;
};

struct HistoryLook {
  bool log = true;
  bool seconds = false; ///< drawn over the column "seconds" where the curve has one; else over the curve's first
};

/// Every column of a curve but its first and "seconds". What is not finite is left out, and on a log axis what is not above 0.
HistoryLines history_lines(const job::Curve& curve, const HistoryLook& look);

class HistoryPlot {
public:
  /// In the window's free width; height in pixels.
  void draw(const HistoryLines& lines, bool log, float height);
  const PlotArea& area() const { return area_; } ///< as drawn last; for tests

private:
  bool follows_ = true; ///< the axes show everything and grow with the run, until somebody zooms or moves them
  bool log_ = true;     ///< as drawn last
  std::string x_;
  PlotArea area_;
};

} // namespace nephroid::ui
