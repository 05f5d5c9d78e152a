// SPDX-License-Identifier: Apache-2.0
// ImPlot's context, which plots of every panel share, and its sizes at the display's scale.
#pragma once

#include <cstdint>

struct ImPlotContext;
struct ImPlotSpec;

namespace nephroid::ui {

/// A line of this colour (IM_COL32) and width in pixels at scale 1, which does not decide what axes show.
ImPlotSpec line_spec(std::uint32_t colour, float width);

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
