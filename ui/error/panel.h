// SPDX-License-Identifier: Apache-2.0
// The panel "Error": the history of the run in hand and of pinned runs, their slopes, and how much faster one is than
// another at equal error.
#pragma once
#include "ui/error/plot.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

/// The metric that the plot shows: the chosen one where any run has it, else the run's own, else the first there is; else empty.
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
  /// id: of a pinned run, 0 for the run in hand.
  const RunLines& lines(std::uint64_t id, const std::shared_ptr<const job::History>& history);
  void draw_toolbar(const Context& context);
  void draw_pins(const Context& context);
  void draw_pin(const Context& context, const PinnedRun& pin);
  std::string findings(const Context& context, const PinnedRun& pin);

  std::map<std::uint64_t, Known> known_;
  PlotContents contents_;
  ErrorPlot plot_;
};

} // namespace nephroid::ui
