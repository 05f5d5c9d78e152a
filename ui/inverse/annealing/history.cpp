// SPDX-License-Identifier: Apache-2.0
// The curves of a run as lines over sweeps, moves or seconds.
#include "ui/inverse/annealing/panel.h"

#include "measure/run_curves.h"
#include "ui/widgets/theme.h"

#include <imgui.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::ui {
namespace {

/// A log axis that follows the run reaches down to this part of the largest value: by rounding some are 1e-14.
constexpr double log_range = 1e-4;

using Ends = std::array<double, 2>;

void widen(Ends& ends, const std::vector<double>& values) {
  for (const double value : values) ends = {std::min(ends[0], value), std::max(ends[1], value)};
}

/// Ends with some room; where there is nothing, 0..1 or a decade.
Ends with_room(const Ends& ends, bool log) {
  if (ends[0] > ends[1]) return log ? Ends{0.1, 1} : Ends{0, 1};
  if (log) return {std::max(ends[0] / 1.25, log_range * ends[1]), ends[1] * 1.25};
  const double room = std::max({0.05 * (ends[1] - ends[0]), 1e-3 * std::abs(ends[1]), 1e-9});
  return {ends[0] - room, ends[1] + room};
}

} // namespace

HistoryLines history_lines(const job::Curve& curve, const HistoryPlotStyle& look) {
  const auto found = std::find(curve.columns.begin(), curve.columns.end(), "seconds");
  const auto seconds = static_cast<std::size_t>(found - curve.columns.begin());
  const std::size_t over = look.seconds && found != curve.columns.end() ? seconds : 0;
  HistoryLines history{curve.name, curve.columns.at(over), {}};
  for (std::size_t column = 1; column < curve.columns.size(); ++column) {
    if (column == seconds) continue;
    HistoryLine line{curve.columns[column], {}, {}};
    for (const std::vector<double>& row : curve.rows) {
      if (!std::isfinite(row[over]) || !std::isfinite(row[column]) || (look.log && row[column] <= 0)) continue;
      line.x.push_back(row[over]);
      line.y.push_back(row[column]);
    }
    history.lines.push_back(std::move(line));
  }
  return history;
}

void HistoryPlot::draw(const HistoryLines& lines, bool log, float height) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (log != log_ || lines.x != x_) follows_ = true; // other axes
  log_ = log;
  x_ = lines.x;
  Ends x{none, -none}, y{none, -none};
  for (const HistoryLine& line : lines.lines) {
    widen(x, line.x);
    widen(y, line.y);
  }
  x = follows_ ? with_room(x, false) : area_.x;
  y = follows_ ? with_room(y, log) : area_.y;
  if (!begin_plot(("##" + lines.name).c_str(), height)) return;
  ImPlot::SetupAxes(lines.x.c_str(), lines.name.c_str());
  if (log) {
    ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_Log10);
    if (const auto ticks = measure::round_levels(y[0], y[1]); ticks.size() > 1 && ticks.size() < 10)
      set_up_ticks(ImAxis_Y1, ticks);
  }
  if (follows_) ImPlot::SetupAxesLimits(x[0], x[1], y[0], y[1], ImPlotCond_Always);
  ImPlot::SetupLegend(ImPlotLocation_North,
                      ImPlotLegendFlags_Outside | ImPlotLegendFlags_Horizontal); // lines end at the right
  ImPlot::SetupFinish();
  for (const HistoryLine& line : lines.lines) {
    if (line.x.empty()) continue;
    ImPlotSpec spec;
    spec.LineWeight = 1.5f * scale();
    if (line.x.size() < 30) { // each row is a sweep
      spec.Marker = ImPlotMarker_Circle;
      spec.MarkerSize = 2 * scale();
    }
    ImPlot::PlotLine(line.name.c_str(), line.x.data(), line.y.data(), static_cast<int>(line.x.size()), spec);
  }
  area_ = PlotArea::in_hand();
  const bool hovered = ImPlot::IsPlotHovered();
  ImPlot::EndPlot();
  if (hovered) follows_ = follows_after_mouse(follows_);
}

} // namespace nephroid::ui
