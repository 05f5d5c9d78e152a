// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/plots.h"

#include "optics/wavelength.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// The limits of the axis, which include dispersion data of glass.
constexpr double lowest_nm = 100, highest_nm = 5000, narrowest_nm = 2;

} // namespace

ImPlotSpec line_spec(std::uint32_t colour, float width) {
  ImPlotSpec spec;
  spec.LineColor = ImGui::ColorConvertU32ToFloat4(colour);
  spec.LineWeight = width * scale();
  spec.Flags = ImPlotItemFlags_NoFit;
  return spec;
}

bool begin_plot(const char* id, float height, int more) {
  return ImPlot::BeginPlot(id, {-1, height},
                           ImPlotFlags_NoTitle | ImPlotFlags_NoMenus | ImPlotFlags_NoMouseText | more);
}

void set_up_fixed_axis(int axis, const char* label, double low, double high, int flags) {
  ImPlot::SetupAxis(axis, label, flags);
  ImPlot::SetupAxisLimits(axis, low, high, ImPlotCond_Always);
}

void set_up_ticks(int axis, const std::vector<double>& ticks) {
  std::vector<std::string> texts;
  std::vector<const char*> labels;
  for (const double tick : ticks) texts.push_back(fmt::format("{:.3g}", tick));
  for (const std::string& text : texts) labels.push_back(text.c_str());
  ImPlot::SetupAxisTicks(axis, ticks.data(), static_cast<int>(ticks.size()), labels.data());
}

PlotArea PlotArea::in_hand() {
  const ImVec2 corner = ImPlot::GetPlotPos(), size = ImPlot::GetPlotSize();
  const ImPlotRect limits = ImPlot::GetPlotLimits();
  return {{corner.x, corner.y, size.x, size.y}, {limits.X.Min, limits.X.Max}, {limits.Y.Min, limits.Y.Max}};
}

bool follows_after_mouse(bool follows) {
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return true;
  const bool drags = ImGui::IsMouseDragging(ImGuiMouseButton_Left) || ImGui::IsMouseDragging(ImGuiMouseButton_Right);
  return follows && !drags && ImGui::GetIO().MouseWheel == 0;
}

std::string in_csv(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

PlotContext::PlotContext() : context_(ImPlot::CreateContext()) { ImPlot::SetCurrentContext(context_); }

PlotContext::~PlotContext() { ImPlot::DestroyContext(context_); }

void PlotContext::follow_scale() {
  if (scale() == std::exchange(scale_, scale())) return;
  ImPlotStyle style;
  style.PlotPadding = {4, 6};
  style.LegendPadding = {8, 8};
  style.MajorTickLen = {6, 6};
  style.MinorTickLen = {3, 3};
  for (ImVec2* size :
       {&style.PlotPadding, &style.LabelPadding, &style.LegendPadding, &style.LegendInnerPadding, &style.LegendSpacing,
        &style.MajorTickLen, &style.MinorTickLen, &style.MousePosPadding, &style.PlotMinSize})
    *size *= scale_;
  style.Colors[ImPlotCol_FrameBg] = {0, 0, 0, 0};
  style.Colors[ImPlotCol_PlotBg] = ImGui::ColorConvertU32ToFloat4(colour::surround);
  style.Colors[ImPlotCol_LegendBg] = ImGui::ColorConvertU32ToFloat4(colour::overlay);
  style.Colors[ImPlotCol_LegendBorder] = {0, 0, 0, 0};
  style.Colors[ImPlotCol_LegendText] = style.Colors[ImPlotCol_InlayText] =
      ImGui::ColorConvertU32ToFloat4(colour::on_dark);
  style.Colors[ImPlotCol_AxisGrid] = ImGui::ColorConvertU32ToFloat4(with_alpha(colour::on_dark, 0.25f));
  ImPlot::GetStyle() = style;
}

void WavelengthAxis::set_up(bool compact) {
  const ImPlotAxisFlags flags = compact ? ImPlotAxisFlags_NoLabel | ImPlotAxisFlags_NoTickLabels : ImPlotAxisFlags_None;
  ImPlot::SetupAxis(ImAxis_X1, "wavelength (nm)", flags);
  ImPlot::SetupAxisLimitsConstraints(ImAxis_X1, lowest_nm, highest_nm);
  ImPlot::SetupAxisZoomConstraints(ImAxis_X1, narrowest_nm, highest_nm - lowest_nm);
  ImPlot::SetupAxisLinks(ImAxis_X1, &low_nm_, &high_nm_);
}

void WavelengthAxis::show_all(double low_nm, double high_nm) {
  low_nm_ = std::max(lowest_nm, std::min<double>(optics::first_nm, low_nm) - margin_nm);
  high_nm_ = std::min(highest_nm, std::max<double>(optics::last_nm, high_nm) + margin_nm);
}

} // namespace nephroid::ui
