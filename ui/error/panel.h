// SPDX-License-Identifier: Apache-2.0
// The panel "Error": the history of the run in hand and of pinned runs, their slopes, and how much faster one is than
// another at equal error.
#pragma once
#include "ui/error/lines.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

struct PlottedRun {
  std::string name;
  std::uint32_t colour = 0;        ///< IM_COL32
  float weight = 1.5f;             ///< the line's width, in pixels at scale 1
  const RunLines* lines = nullptr; ///< outlives the call
};

struct PlotContents {
  std::string metric;
  std::vector<PlottedRun> runs; ///< the one in front last
  std::optional<double> target;
};

/// Error against time on two log axes: lines of several runs, noise floor, target, and the values under the cursor.
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

/// The metric that the plot shows: the chosen one where any run has it, else the run's own, else the first there is;
/// else empty.
std::string shown_metric(const Context& context);
/// Every number of the plot as CSV (plot_csv); of the run in hand and of the pinned runs that are shown.
std::string plot_as_csv(const Context& context);

class ErrorPanel : public Panel {
public:
  static constexpr const char* title = "Error";
  void draw(const Context& context) override;

  /// For tests: what was drawn last.
  const ErrorPlot& plot() const { return plot_; }
  const PlotContents& contents() const { return contents_; }

private:
  /// Lines of a history, made anew when the history or the metric is another.
  struct Known {
    std::shared_ptr<const job::History> history;
    std::string metric;
    RunLines lines;
  };

  void collect(const Context& context);
  /// id: a pinned run's, or 0 for the run in hand.
  const RunLines& lines(std::uint64_t id, const std::shared_ptr<const job::History>& history);
  void draw_toolbar(const Context& context);
  void draw_pin(const Context& context, const PinnedRun& pin);
  std::string findings(const Context& context, const PinnedRun& pin);

  std::map<std::uint64_t, Known> known_;
  PlotContents contents_;
  ErrorPlot plot_;
};

} // namespace nephroid::ui
