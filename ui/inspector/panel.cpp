// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/panel.h"

#include "optics/wavelength.h"
#include "preset/read.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::ui {
namespace {

constexpr int reach = 5; ///< neighbours to each side

/// The picture that the View shows: a difference has no colours of its own to enlarge.
HeldPicture enlarged(const Context& context) {
  const HeldPicture other = context.comparing.comparison().flip ? context.comparing.other_picture() : HeldPicture{};
  return other.owner ? other : context.comparing.picture();
}

constexpr ImGuiTableFlags table_flags =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;

void number(double value) { cell(std::isnan(value) ? "NaN" : fmt::format("{:.4g}", value)); }

void names(std::initializer_list<const char*> columns) {
  for (const char* column : columns) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
}

void draw_pixel_table(const std::vector<PixelRow>& rows) {
  if (!ImGui::BeginTable("pixel", 8, table_flags | ImGuiTableFlags_ScrollX,
                         {0, static_cast<float>(rows.size() + 2) * ImGui::GetTextLineHeightWithSpacing() +
                                 ImGui::GetStyle().ScrollbarSize}))
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

/// A table a picture, and how many pixels are no ordinary ones.
void draw_region_tables(const RegionStatistics& statistics) {
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
      draw_wrapped(colour::error, fmt::format("Of {} pixels {} are NaN and {} infinite; they are left out.",
                                              picture.pixels, picture.nan, picture.infinite));
    if (picture.dark + picture.coloured > 0 && picture.name != "difference")
      draw_wrapped(colour::quiet_text, fmt::format("Of {} pixels {} have a negative luminance, {} a negative channel.",
                                                   picture.pixels, picture.dark, picture.coloured));
    ImGui::PopID();
  }
}

/// Pixels over their luminance, both logarithmic.
void draw_histogram(const RegionStatistics& statistics) {
  const Histogram& histogram = statistics.histogram;
  if (!ImPlot::BeginPlot("##histogram", {-1, 11 * em()}, ImPlotFlags_NoMouseText)) return;
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
      edges.push_back(std::pow(10, histogram.first + (histogram.last - histogram.first) * static_cast<double>(bin) /
                                                         static_cast<double>(counts.size())));
    steps.push_back(counts.empty() ? 0 : counts.back());
    ImPlot::PlotStairs(statistics.pictures[i].name.c_str(), edges.data(), steps.data(), static_cast<int>(edges.size()));
  }
  ImPlot::EndPlot();
}

} // namespace

void InspectorPanel::draw(const Context& context) {
  places_.clear();
  if (!context.comparing.source()) {
    draw_wrapped(colour::quiet_text, "There is no picture yet.");
    return;
  }
  draw_pixel(context);
  ImGui::Spacing();
  draw_region(context);
}

void InspectorPanel::draw_pixel(const Context& context) {
  const auto& pixel = context.view_state.pixel;
  ImGui::SeparatorText(pixel ? fmt::format("Pixel ({}, {})", (*pixel)[0], (*pixel)[1]).c_str() : "Pixel");
  if (!pixel) {
    draw_wrapped(colour::quiet_text,
                 "Alt and a click on the picture takes a pixel, or I the one in the middle; the arrow keys move it.");
    return;
  }
  const std::vector<PixelRow> rows = pixel_rows(context, *pixel);
  if (rows.empty()) {
    draw_wrapped(colour::note,
                 "It lies outside of the picture, which has another size now. The arrow keys bring it back.");
    return;
  }
  action_button("Copy pixel", context);
  places_.note("copy pixel");
  ImGui::SameLine();
  if (places_.button("Let go", "let go")) context.push(command::InspectPixel{});
  draw_neighbours(context);
  ImGui::SameLine();
  draw_pixel_table(rows);
  draw_spectrum(context);
}

void InspectorPanel::draw_neighbours(const Context& context) {
  const HeldPicture picture = enlarged(context);
  const ViewSettings& view_settings = context.view_state.view_settings;
  const std::array<int, 2> pixel = *context.view_state.pixel;
  const double white = context.white();
  const image::Display display = context.display();
  Neighbours& n = neighbours_;
  constexpr int across = 2 * reach + 1;
  if (picture.owner && (n.owner != picture.owner || n.pixel != pixel || n.view_settings != view_settings ||
                        n.display != display || n.white != white)) {
    n = {picture.owner, pixel, view_settings,
         display,       white, std::vector<unsigned char>(std::size_t{4} * across * across, 0)};
    const Tone tone = tone_of(view_settings, display, white, picture.pixels.rgb);
    for (int i = 0; i < across * across; ++i) {
      const int x = pixel[0] - reach + i % across, y = pixel[1] - reach + i / across;
      if (x < 0 || y < 0 || x >= picture.pixels.width || y >= picture.pixels.height) continue;
      const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.pixels.width) +
                           static_cast<std::size_t>(x));
      toned_pixels(picture.pixels.rgb.subspan(at, 3), tone,
                   std::span(n.rgba).subspan(4 * static_cast<std::size_t>(i), 4));
    }
  }
  const float cell = std::max(std::floor(0.7f * em()), 1.0f), size = across * cell;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({size, size});
  if (!picture.owner) return;
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  for (int i = 0; i < across * across; ++i) {
    const unsigned char* c = &n.rgba[4 * static_cast<std::size_t>(i)];
    const int row = i / across, column = i % across;
    const ImVec2 at = corner + ImVec2(static_cast<float>(column), static_cast<float>(row)) * cell;
    draw_list->AddRectFilled(at, at + ImVec2(cell, cell), IM_COL32(c[0], c[1], c[2], c[3]));
  }
  const ImVec2 own = corner + ImVec2(reach, reach) * cell, end = own + ImVec2(cell, cell);
  draw_list->AddRect(own - ImVec2(1, 1), end + ImVec2(1, 1), colour::outline);
  draw_list->AddRect(own, end, colour::on_dark);
}

void InspectorPanel::draw_spectrum(const Context& context) {
  const auto& spectrum = context.run.spectrum();
  if (!spectrum || spectrum->pixel != *context.view_state.pixel) return;
  if (!spectrum->why_not.empty()) return offer_spectra(context, *spectrum);
  std::array<double, optics::wavelength_count> nm{};
  std::iota(nm.begin(), nm.end(), optics::first_nm);
  const std::vector<double> total = total_radiance(*spectrum);
  const double most = *std::max_element(total.begin(), total.end());
  const ImVec2 size{-1, 13 * em()};
  if (ImPlot::BeginPlot("##spectrum", size, ImPlotFlags_NoMouseText)) {
    axis_.set_up();
    set_up_fixed_axis(ImAxis_Y1, "W/m2/sr/nm", 0, most > 0 ? 1.1 * most : 1,
                      ImPlotAxisFlags_Lock | ImPlotAxisFlags_NoHighlight);
    ImPlot::SetupFinish();
    if (spectrum->layers.size() > 1)
      for (const auto& layer : spectrum->layers)
        ImPlot::PlotLine(layer.name.c_str(), nm.data(), layer.radiance.data(), static_cast<int>(nm.size()));
    ImPlot::PlotLine("this pixel", nm.data(), total.data(), static_cast<int>(nm.size()), line_spec(colour::on_dark, 2));
    if (ImPlot::IsPlotHovered())
      if (const long w = std::lround(ImPlot::GetPlotMousePos().x) - optics::first_nm; w >= 0 && w < std::ssize(total))
        ImGui::SetTooltip("%ld nm: %.4g W/m2/sr/nm", w + optics::first_nm, total[static_cast<std::size_t>(w)]);
    ImPlot::EndPlot();
  }
  if (places_.button("Copy spectrum", "copy spectrum", "A wavelength a row, as CSV"))
    ImGui::SetClipboardText(spectrum_as_csv(*spectrum).c_str());
  for (const std::string& note : spectrum->notes) draw_wrapped(colour::quiet_text, note);
}

void InspectorPanel::offer_spectra(const Context& context, const job::PixelSpectrum& none) {
  draw_wrapped(colour::quiet_text, "No spectrum: " + none.why_not + ".");
  if (none.remedy.empty()) return;
  if (places_.button("Keep spectra", "keep spectra",
                     "Sets " + none.remedy + ", which starts the run again; one edit to undo"))
    context.push(command::Edit{
        .label = "keep spectra", .preset = preset::with_overrides(*context.preset(), {none.remedy}), .was_read = true});
}

void InspectorPanel::draw_region(const Context& context) {
  const HeldPicture picture = context.comparing.picture();
  const auto& chosen = context.view_state.region;
  const auto region =
      chosen && picture.owner ? cut_to(*chosen, picture.pixels.width, picture.pixels.height) : std::nullopt;
  ImGui::SeparatorText(region ? fmt::format("Region {} x {} at ({}, {})", region->to[0] - region->from[0],
                                            region->to[1] - region->from[1], region->from[0], region->from[1])
                                    .c_str()
                              : "Region");
  if (!region) {
    statistics_.forget(context.tasks);
    draw_wrapped(colour::quiet_text,
                 !chosen         ? "Alt and a drag on the picture takes a rectangle, Shift+I the whole picture."
                 : picture.owner ? "The rectangle lies outside of the picture, which has another size now."
                                 : context.comparing.why_no_picture());
    return;
  }
  const HeldPicture other = context.comparing.other_picture();
  const std::string other_name = context.comparing.comparison().pin == 0 ? "reference" : other.pixels.name;
  request_statistics(statistics_, context.tasks, {picture, other, other_name, *region, context.white()});
  const auto& statistics = statistics_.newest();
  if (!statistics) return draw_wrapped(colour::quiet_text, "The statistics are being made.");
  if (places_.button("Copy as CSV", "copy region")) ImGui::SetClipboardText(to_csv(*statistics).c_str());
  ImGui::SameLine();
  if (places_.button("Clear", "clear")) context.push(command::SelectRegion{});
  draw_region_tables(*statistics);
  draw_histogram(*statistics);
}

} // namespace nephroid::ui
