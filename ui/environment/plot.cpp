// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/plot.h"

#include "environment/describe_settings.h"
#include "measure/run_curves.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

constexpr double to_percent = 100;
constexpr double room = 1.3; ///< beside the outermost points, as a factor

void plot_method(const std::string& name, const Quality& errors)
{
  std::vector<double> lights, values;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i] > 0)) continue;
    lights.push_back(quality_lights.at(i));
    values.push_back(to_percent * errors[i]);
  }
  ImPlotSpec spec;
  spec.LineWeight = 1.5f * scale();
  spec.Marker = ImPlotMarker_Circle;
  spec.MarkerSize = 2 * scale();
  ImPlot::PlotLine(name.c_str(), lights.data(), values.data(), static_cast<int>(lights.size()), spec);
}

} // namespace

std::array<double, 2> error_range(const ShownMap& shown)
{
  double least = 0, most = 0;
  const auto widen = [&](double error) {
    if (!(error > 0)) return;
    least = least > 0 ? std::min(least, to_percent * error) : to_percent * error;
    most = std::max(most, to_percent * error);
  };
  for (const Quality& errors : shown.quality)
    for (const double error : errors) widen(error);
  if (shown.cut_error) widen(*shown.cut_error);
  if (most == 0) return {1, 10};
  return {least / room, most * room};
}

void QualityPlot::draw(const ShownMap& shown, float height)
{
  constexpr ImPlotFlags flags = ImPlotFlags_NoTitle | ImPlotFlags_NoMenus | ImPlotFlags_NoMouseText;
  if (!ImPlot::BeginPlot("##quality", {-1, height}, flags)) return;
  ImPlot::SetupAxes("lights", "irradiance error (%)");
  ImPlot::SetupAxisScale(ImAxis_X1, ImPlotScale_Log10);
  ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_Log10);
  const double lights = shown.cut ? shown.cut->settings.lights : quality_lights.front();
  const std::array<double, 2> range = error_range(shown);
  ImPlot::SetupAxesLimits(quality_lights.front() / room, std::max<double>(quality_lights.back(), lights) * room, range[0], range[1],
                          ImPlotCond_Always);
  set_up_ticks(ImAxis_X1, {6, 8, 12, 16, 24, 32, 48, 64, 128, 256, 1024, 4096});
  if (const std::vector<double> ticks = measure::round_levels(range[0], range[1]); ticks.size() > 1) set_up_ticks(ImAxis_Y1, ticks);
  ImPlot::SetupLegend(ImPlotLocation_NorthEast);
  ImPlot::SetupFinish();
  for (const auto& choice : preset::choices<environment::SegmentMethod>)
    plot_method(std::string(choice.name), shown.quality.at(static_cast<std::size_t>(choice.value)));
  if (shown.cut_error && *shown.cut_error > 0) {
    const double error = to_percent * *shown.cut_error;
    ImPlotSpec spec;
    spec.Marker = ImPlotMarker_Circle;
    spec.MarkerSize = 5 * scale();
    spec.MarkerFillColor = {0, 0, 0, 0};
    spec.MarkerLineColor = {1, 1, 1, 1};
    spec.LineWeight = 2 * scale();
    ImPlot::PlotScatter("##now", &lights, &error, 1, spec);
  }
  area_ = PlotArea::in_hand();
  ImPlot::EndPlot();
}

} // namespace nephroid::ui
