// SPDX-License-Identifier: Apache-2.0
// The plot of one curve of a run: its columns over sweeps, moves or seconds.
#pragma once
#include "ui/inverse/annealing/history.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

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
