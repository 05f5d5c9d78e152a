// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/tables.h"

#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <implot.h>

#include <array>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr ImGuiTableFlags table_flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;

void cell(const std::string& text)
{
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

void number(double value) { cell(std::isnan(value) ? "NaN" : fmt::format("{:.4g}", value)); }

void names(std::initializer_list<const char*> columns)
{
  for (const char* column : columns) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
}

} // namespace

void draw_pixel_table(const std::vector<PixelRow>& rows)
{
  if (!ImGui::BeginTable(
          "pixel", 8, table_flags | ImGuiTableFlags_ScrollX,
          {0, static_cast<float>(rows.size() + 2) * ImGui::GetTextLineHeightWithSpacing() + ImGui::GetStyle().ScrollbarSize}))
    return;
  ImGui::TableSetupScrollFreeze(1, 1);
  names({"", "R", "G", "B", "Y W/m2/sr", "L*", "a*", "b*"});
  for (const PixelRow& row : rows) {
    ImGui::TableNextRow();
    cell(row.name);
    for (const float channel : row.rgb) number(static_cast<double>(channel));
    number(row.luminance);
    for (const double value : row.lab) row.is_colour ? number(value) : cell("");
  }
  ImGui::EndTable();
}

void draw_region_tables(const RegionStatistics& statistics)
{
  for (const PictureStatistics& picture : statistics.pictures) {
    ImGui::PushID(&picture);
    if (ImGui::BeginTable("statistics", 6, table_flags)) {
      names({picture.name.c_str(), "mean", "deviation", "min", "max", "median"});
      for (std::size_t q = 0; q < region_quantities.size(); ++q) {
        const Moments& m = picture.of[q];
        ImGui::TableNextRow();
        cell(q == 0 ? "Y W/m2/sr" : region_quantities[q]);
        for (const double value : {m.mean, m.deviation, m.least, m.most, m.median}) number(value);
      }
      ImGui::EndTable();
    }
    if (picture.nan + picture.infinite > 0)
      draw_wrapped(colour::error, fmt::format("Of {} pixels {} are NaN and {} infinite; they are left out.", picture.pixels, picture.nan,
                                              picture.infinite));
    if (picture.dark + picture.coloured > 0 && picture.name != "difference")
      draw_wrapped(colour::quiet_text, fmt::format("Of {} pixels {} have a negative luminance, {} a negative channel.", picture.pixels,
                                                   picture.dark, picture.coloured));
    ImGui::PopID();
  }
}

void draw_histogram(const RegionStatistics& statistics)
{
  const Histogram& histogram = statistics.histogram;
  if (!ImPlot::BeginPlot("##histogram", {-1, 11 * ImGui::GetFontSize()}, ImPlotFlags_NoMouseText)) return;
  ImPlot::SetupAxes("W/m2/sr", "pixels", ImPlotAxisFlags_AutoFit, ImPlotAxisFlags_AutoFit);
  ImPlot::SetupAxisScale(ImAxis_X1, ImPlotScale_Log10);
  ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_SymLog); // which has 0, and no numbers of its own
  constexpr std::array numbers{0.0, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7};
  constexpr std::array<const char*, numbers.size()> labels{"0", "1", "10", "100", "1e3", "1e4", "1e5", "1e6", "1e7"};
  ImPlot::SetupAxisTicks(ImAxis_Y1, numbers.data(), static_cast<int>(numbers.size()), labels.data());
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const std::vector<double>& counts = histogram.counts[i];
    std::vector<double> edges, steps = counts;
    for (std::size_t bin = 0; bin <= counts.size(); ++bin)
      edges.push_back(std::pow(10, histogram.first +
                                       (histogram.last - histogram.first) * static_cast<double>(bin) / static_cast<double>(counts.size())));
    steps.push_back(counts.empty() ? 0 : counts.back());
    ImPlot::PlotStairs(statistics.pictures[i].name.c_str(), edges.data(), steps.data(), static_cast<int>(edges.size()));
  }
  ImPlot::EndPlot();
}

} // namespace nephroid::ui
