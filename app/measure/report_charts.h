// SPDX-License-Identifier: Apache-2.0
// Charts of error against time, drawn by gnuplot as SVG.
#pragma once
#include "measure/report_analysis.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::measure {

/// The colour of a run everywhere on the page, "#rrggbb"; legible on white and on black. Comes round again after eight.
std::string run_colour(std::size_t run);

struct ChartLine {
  std::string label; ///< for the legend; empty: none
  std::size_t run = 0;
  bool is_estimate = false; ///< drawn dashed
  Curve curve;
};

struct Chart {
  std::string title;       ///< for those who hear the page
  std::string y_axis;      ///< with its unit
  bool logarithmic = true; ///< the axis of errors; that of time always is
  std::vector<ChartLine> lines;
  std::optional<double> guide_exponent; ///< of a dotted line that shows a slope
  std::vector<double> noise_floors;     ///< horizontal dashed lines
};

/// An <svg> element for each chart, whose text and lines take the colour of the page's text, with ids unique among them. Throws failed
/// where gnuplot is missing or fails. Charts must have a line with a point.
std::vector<std::string> draw_charts(std::span<const Chart> charts);

} // namespace nephroid::measure
