// SPDX-License-Identifier: Apache-2.0
// The curves of a run (job::Curve) as lines to plot: the cost, and whatever else an engine notes about its search. No Dear ImGui.
#pragma once
#include "job/job.h"

#include <string>
#include <vector>

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

} // namespace nephroid::ui
