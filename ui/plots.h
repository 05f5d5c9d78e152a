// SPDX-License-Identifier: Apache-2.0
// ImPlot's context, which plots of every panel share, and its sizes at the display's scale.
#pragma once

struct ImPlotContext;

namespace nephroid::ui {

class PlotContext {
public:
  /// A Dear ImGui context must be there, and stay longer than this.
  PlotContext();
  ~PlotContext();
  PlotContext(const PlotContext&) = delete;
  PlotContext& operator=(const PlotContext&) = delete;
  /// Once a frame, before panels draw.
  void follow_scale();

private:
  ImPlotContext* context_ = nullptr;
  float scale_ = 0;
};

} // namespace nephroid::ui
