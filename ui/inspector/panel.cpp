// SPDX-License-Identifier: Apache-2.0
#include "ui/inspector/panel.h"

#include "optics/wavelength.h"
#include "preset/read.h"
#include "ui/inspector/pixel.h"
#include "ui/inspector/tables.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr int reach = 5; ///< neighbours to each side

std::vector<double> wavelengths()
{
  std::vector<double> nm;
  for (int w = 0; w < optics::wavelength_count; ++w) nm.push_back(optics::wavelength_nm(w));
  return nm;
}

/// The picture that the View shows: a difference has no colours of its own to enlarge.
HeldPicture enlarged(const Context& context)
{
  const HeldPicture other = context.comparing.comparison().flip ? context.comparing.other_picture() : HeldPicture{};
  return other.owner ? other : context.comparing.picture();
}

} // namespace

void InspectorPanel::draw(const Context& context)
{
  places_.clear();
  if (!context.run.snapshot()) {
    draw_wrapped(colour::quiet_text, "There is no picture yet.");
    return;
  }
  draw_pixel(context);
  ImGui::Spacing();
  draw_region(context);
}

void InspectorPanel::draw_pixel(const Context& context)
{
  const auto& pixel = context.chosen.pixel;
  ImGui::SeparatorText(pixel ? fmt::format("Pixel ({}, {})", (*pixel)[0], (*pixel)[1]).c_str() : "Pixel");
  if (!pixel) {
    draw_wrapped(colour::quiet_text, "Alt and a click on the picture takes a pixel, or I the one in the middle; the arrow keys move it.");
    return;
  }
  const std::vector<PixelRow> rows = pixel_rows(context, *pixel);
  if (rows.empty()) {
    draw_wrapped(colour::note, "It lies outside of the picture, which has another size now. The arrow keys bring it back.");
    return;
  }
  action_button("Copy pixel", context);
  places_.note("copy pixel");
  ImGui::SameLine();
  if (ImGui::Button("Let go")) context.push(command::InspectPixel{});
  places_.note("let go");
  draw_neighbours(context);
  ImGui::SameLine();
  draw_pixel_table(rows);
  draw_spectrum(context);
}

void InspectorPanel::draw_neighbours(const Context& context)
{
  const HeldPicture picture = enlarged(context);
  const Look& look = context.chosen.look;
  const std::array<int, 2> pixel = *context.chosen.pixel;
  const double white = context.preset() ? context.preset()->white : 1;
  Neighbours& n = neighbours_;
  constexpr int across = 2 * reach + 1;
  if (picture.owner && (n.owner != picture.owner || n.pixel != pixel || n.look != look || n.white != white)) {
    n = {picture.owner, pixel, look, white, std::vector<unsigned char>(std::size_t{4} * across * across, 0)};
    const Tone tone = tone_of(look, white, picture.pixels.rgb);
    for (int i = 0; i < across * across; ++i) {
      const int x = pixel[0] - reach + i % across, y = pixel[1] - reach + i / across;
      if (x < 0 || y < 0 || x >= picture.pixels.width || y >= picture.pixels.height) continue;
      const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.pixels.width) + static_cast<std::size_t>(x));
      toned_pixels(picture.pixels.rgb.subspan(at, 3), tone, std::span(n.rgba).subspan(4 * static_cast<std::size_t>(i), 4));
    }
  }
  const float cell = std::max(std::floor(ImGui::GetFontSize() * 0.7f), 1.0f), size = across * cell;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({size, size});
  if (!picture.owner) return;
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  for (int i = 0; i < across * across; ++i) {
    const unsigned char* c = &n.rgba[4 * static_cast<std::size_t>(i)];
    const int column = i % across, row = i / across;
    const ImVec2 at{corner.x + static_cast<float>(column) * cell, corner.y + static_cast<float>(row) * cell};
    draw_list->AddRectFilled(at, {at.x + cell, at.y + cell}, IM_COL32(c[0], c[1], c[2], c[3]));
  }
  const ImVec2 own{corner.x + reach * cell, corner.y + reach * cell};
  draw_list->AddRect({own.x - 1, own.y - 1}, {own.x + cell + 1, own.y + cell + 1}, colour::outline);
  draw_list->AddRect(own, {own.x + cell, own.y + cell}, colour::on_dark);
}

void InspectorPanel::draw_spectrum(const Context& context)
{
  const auto& spectrum = context.run.spectrum();
  if (!spectrum || spectrum->pixel != *context.chosen.pixel) return;
  if (!spectrum->why_not.empty()) return offer_spectra(context, *spectrum);
  static const std::vector<double> nm = wavelengths();
  const std::vector<double> total = total_radiance(*spectrum);
  const double most = *std::max_element(total.begin(), total.end());
  const ImVec2 size{-1, 13 * ImGui::GetFontSize()};
  if (ImPlot::BeginPlot("##spectrum", size, ImPlotFlags_NoMouseText)) {
    axis_.set_up();
    ImPlot::SetupAxis(ImAxis_Y1, "W/m2/sr/nm", ImPlotAxisFlags_Lock | ImPlotAxisFlags_NoHighlight);
    ImPlot::SetupAxisLimits(ImAxis_Y1, 0, most > 0 ? 1.1 * most : 1, ImPlotCond_Always);
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
  if (ImGui::Button("Copy spectrum")) ImGui::SetClipboardText(spectrum_as_csv(*spectrum).c_str());
  places_.note("copy spectrum");
  ImGui::SetItemTooltip("A wavelength a row, as CSV");
  for (const std::string& note : spectrum->notes) draw_wrapped(colour::quiet_text, note);
}

/// What the remedy contradicts is said once it is tried.
void InspectorPanel::offer_spectra(const Context& context, const job::PixelSpectrum& none)
{
  draw_wrapped(colour::quiet_text, "No spectrum: " + none.why_not + ".");
  if (none.remedy.empty() || !context.preset()) return;
  if (ImGui::Button("Keep spectra"))
    context.push(
        command::Edit{"keep spectra", preset::parse_preset(preset::to_json(*context.preset()), context.preset()->source, {none.remedy})});
  places_.note("keep spectra");
  ImGui::SetItemTooltip("Sets %s, which starts the run again; one edit to undo", none.remedy.c_str());
}

void InspectorPanel::draw_region(const Context& context)
{
  const HeldPicture picture = context.comparing.picture();
  const auto& chosen = context.chosen.region;
  const auto region = chosen && picture.owner ? cut_to(*chosen, picture.pixels.width, picture.pixels.height) : std::nullopt;
  ImGui::SeparatorText(region ? fmt::format("Region {} x {} at ({}, {})", region->to[0] - region->from[0], region->to[1] - region->from[1],
                                            region->from[0], region->from[1])
                                    .c_str()
                              : "Region");
  if (!region) {
    statistics_.forget(context.tasks);
    draw_wrapped(colour::quiet_text, !chosen         ? "Alt and a drag on the picture takes a rectangle, Shift+I the whole picture."
                                     : picture.owner ? "The rectangle lies outside of the picture, which has another size now."
                                                     : context.comparing.why_no_picture());
    return;
  }
  const HeldPicture other = context.comparing.other_picture();
  const PinnedRun* pin = context.comparing.pinned().find(context.comparing.comparison().pin);
  want_statistics(statistics_, context.tasks,
                  {picture, other, pin ? pin->name : "reference", *region, context.preset() ? context.preset()->white : 1});
  const auto& statistics = statistics_.newest();
  if (!statistics) return draw_wrapped(colour::quiet_text, "The statistics are being made.");
  if (ImGui::Button("Copy as CSV")) ImGui::SetClipboardText(to_csv(*statistics).c_str());
  places_.note("copy region");
  ImGui::SameLine();
  if (ImGui::Button("Clear")) context.push(command::SelectRegion{});
  places_.note("clear");
  draw_region_tables(*statistics);
  draw_histogram(*statistics);
}

} // namespace nephroid::ui
