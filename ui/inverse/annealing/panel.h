// SPDX-License-Identifier: Apache-2.0
// The panel "Annealing" of engine 3: how the search goes, what every receiver shows, and where the light of a facet
// goes. Distances are dragged in it, and the search goes on from where it was.
#pragma once
#include "inverse/layout.h"
#include "inverse/settings.h"
#include "job/job.h"
#include "ui/inverse/annealing/pictures.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

struct ImVec2;

namespace nephroid::ui {

/// The curves of a run (job::Curve) as lines over sweeps, moves or seconds: the cost, and what else an engine notes.
struct HistoryLine {
  std::string name; ///< its column
  std::vector<double> x, y;
};

struct HistoryLines {
  std::string name; ///< the curve's name
  std::string x;    ///< the column that the lines are drawn over
  std::vector<HistoryLine> lines;
};

struct HistoryPlotStyle {
  bool log = true;
  bool seconds = false; ///< drawn over the column "seconds" where the curve has one; else over the curve's first
};

/// Every column of a curve but its first and "seconds", without what is not finite, or on a log axis not above 0.
HistoryLines history_lines(const job::Curve& curve, const HistoryPlotStyle& look);

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

class AnnealingPanel : public Panel {
public:
  static constexpr const char* title = "Annealing";
  void draw(const Context& context) override;

  /// For tests: what was drawn last, and where.
  const std::vector<HistoryLines>& histories() const { return histories_; }
  const std::optional<FacetBeam>& beam() const { return beam_; }
  /// x, y, width and height of a picture on the screen; zeros where it was not drawn.
  std::array<double, 4> area_of(const std::string& picture) const;

private:
  void follow(const Context& context);
  void draw_toolbar(const Context& context);
  void draw_histories();
  void draw_figures(const job::Snapshot& snapshot) const;
  void draw_receivers(const Context& context);
  void draw_distance(const Context& context, std::size_t receiver);
  void draw_weight(const Context& context, std::size_t receiver);
  void draw_receiver_picture(const std::string& kind, std::size_t receiver, const ImVec2& size);
  void draw_beam_row(const ImVec2& size);
  void draw_facets();
  void draw_facet_map(const std::string& picture, const ImVec2& size);
  void draw_facet_text() const;

  HistoryPlotStyle look_;
  std::map<std::string, HistoryPlot> plots_; ///< a plot per curve
  std::vector<HistoryLines> histories_;
  RunPictures pictures_;
  std::shared_ptr<const job::Snapshot> snapshot_;
  inverse::Settings settings_; ///< that the layout is of
  std::string source_;
  std::optional<inverse::Layout> layout_; ///< empty: settings_ cannot be laid out
  std::string why_no_layout_;
  std::optional<glm::ivec2> facet_; ///< that was clicked
  std::optional<FacetBeam> beam_;   ///< its own
  Gestures gestures_{title};
  std::map<std::string, std::array<double, 4>> areas_;
};

} // namespace nephroid::ui
