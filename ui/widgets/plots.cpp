// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/plots.h"

#include "ui/widgets/theme.h"

#include <imgui.h>
#include <implot.h>

#include <utility>

namespace nephroid::ui {

ImPlotSpec line_spec(std::uint32_t colour, float width)
{
  ImPlotSpec spec;
  spec.LineColor = ImGui::ColorConvertU32ToFloat4(colour);
  spec.LineWeight = width * scale();
  spec.Flags = ImPlotItemFlags_NoFit;
  return spec;
}

PlotContext::PlotContext() : context_(ImPlot::CreateContext()) { ImPlot::SetCurrentContext(context_); }

PlotContext::~PlotContext() { ImPlot::DestroyContext(context_); }

void PlotContext::follow_scale()
{
  if (scale() == std::exchange(scale_, scale())) return;
  const auto scaled = [&](ImVec2& size) { size = {size.x * scale_, size.y * scale_}; };
  ImPlotStyle style;
  style.PlotPadding = {4, 6};
  style.LegendPadding = {8, 8};
  style.MajorTickLen = {6, 6};
  style.MinorTickLen = {3, 3};
  for (ImVec2* size : {&style.PlotPadding, &style.LabelPadding, &style.LegendPadding, &style.LegendInnerPadding, &style.LegendSpacing,
                       &style.MajorTickLen, &style.MinorTickLen, &style.MousePosPadding, &style.PlotMinSize})
    scaled(*size);
  style.Colors[ImPlotCol_FrameBg] = {0, 0, 0, 0};
  style.Colors[ImPlotCol_PlotBg] = ImGui::ColorConvertU32ToFloat4(colour::surround);
  style.Colors[ImPlotCol_LegendBg] = ImGui::ColorConvertU32ToFloat4(colour::overlay);
  style.Colors[ImPlotCol_LegendBorder] = {0, 0, 0, 0};
  ImPlot::GetStyle() = style;
}

} // namespace nephroid::ui
