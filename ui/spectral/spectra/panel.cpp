// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/spectra/panel.h"

#include "base/counted.h"
#include "preset/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr std::size_t most_seen = 6; ///< materials around the glass that the table shows without scrolling

/// A box with a piece of its curve: the switches are the plot's legend. first: it begins a line.
bool draw_switch(const std::string& name, std::uint32_t colour, bool& on, bool first = false) {
  const float swatch = em(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const std::string ten_spaces(10, ' '); // ImGui rounds what a text is wide
  const float space = ImGui::CalcTextSize(ten_spaces.c_str()).x / 10;
  const std::string room(static_cast<std::size_t>(std::ceil((swatch + 1.5f * gap) / space)), ' '), label = room + name;
  if (!first) same_line_if_room(ImGui::GetFrameHeight() + gap + ImGui::CalcTextSize(label.c_str(), nullptr, true).x);
  const bool changed = ImGui::Checkbox(label.c_str(), &on);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float x = low.x + ImGui::GetFrameHeight() + gap, y = std::round((low.y + high.y) / 2), half = em() / 8;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({x, y - half}, {x + swatch, y + half}, on ? colour : colour::frame);
  if (spectra_colour::is_dark(colour))
    list.AddRect({x - 1, y - half - 1}, {x + swatch + 1, y + half + 1}, spectra_colour::rim);
  return changed;
}

std::string times(std::int64_t more, std::int64_t fewer) {
  return fmt::format("{:.3g}", static_cast<double>(more) / static_cast<double>(fewer));
}

} // namespace

void SpectraPanel::draw(const Context& context) {
  places_.clear();
  maker_.update(*context.preset(), context.run.scene_facts().spectra);
  choose_light(*context.preset());
  draw_light(context);
  draw_switches();
  const Spectra& spectra = maker_.spectra();
  const float line = ImGui::GetTextLineHeight(), cell = line + 2 * ImGui::GetStyle().CellPadding.y;
  const auto seen = spectra.importance.surroundings.size();
  const float table =
      seen == 0 ? 0 : static_cast<float>(std::min(seen, most_seen) + 1) * cell + ImGui::GetStyle().ItemSpacing.y;
  const float below = 2 * line + 2 * ImGui::GetStyle().ItemSpacing.y + table;
  draw_plot(context, std::max(ImGui::GetContentRegionAvail().y - below, 16 * em()));
  draw_numbers();
  draw_surroundings();
}

/// The edited light of another preset, or of one with fewer lights, is the first.
void SpectraPanel::choose_light(const preset::Preset& preset) {
  if (source_ != preset.source || light_ >= preset.scene.lights.size()) light_ = 0;
  source_ = preset.source;
  spectrum_ = preset.scene.lights.empty() ? preset::LightSpectrum{} : sorted(preset.scene.lights[light_].spectrum);
  editor_.keep(has_rows(spectrum_) ? spectrum_.table.size() : 0);
}

void SpectraPanel::draw_light(const Context& context) {
  if (context.preset()->scene.lights.empty()) {
    draw_wrapped(colour::note, "The scene has no light");
    return;
  }
  draw_light_choice(*context.preset());
  draw_spectrum_controls(context);
  if (const std::string& error = maker_.spectra().lights[light_].error; !error.empty())
    draw_wrapped(colour::error, error);
}

void SpectraPanel::draw_light_choice(const preset::Preset& preset) {
  const auto name = [&](std::size_t i) {
    return fmt::format("Light {}, {}", i + 1, preset::word(preset.scene.lights[i].type));
  };
  if (preset.scene.lights.size() == 1) return draw_label("Light");
  ImGui::SetNextItemWidth(10 * em());
  Combo list("##light", name(light_), &places_, "light");
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i)
    if (list.entry(name(i), i == light_)) {
      light_ = i;
      editor_.unmark();
      spectrum_ = sorted(preset.scene.lights[i].spectrum);
    }
}

void SpectraPanel::draw_spectrum_controls(const Context& context) {
  same_line_if_room(8 * em());
  if (has_rows(spectrum_)) {
    ImGui::TextDisabled("%s", counted(spectrum_.table.size(), "row").c_str());
    tooltip("Drag a point. A double click adds one, a click with the right button removes one.");
    ImGui::SameLine();
    follow_rows(context, draw_row_buttons(in_widest_gap(spectrum_), editor_.marked(), places_));
    return;
  }
  if (places_.button("Make editable", "make editable", "Rows every 20 nm, to drag"))
    context.edit(fmt::format("make rows of light {}", light_ + 1),
                 [&](preset::Preset& p) { p.scene.lights[light_].spectrum = as_table(spectrum_); });
}

void SpectraPanel::draw_switches() {
  const Spectra& spectra = maker_.spectra();
  draw_switch("light", spectra_colour::light, switches_.light, true);
  tooltip("Power a nanometre of each light, relative to its largest; the one that is edited is filled");
  draw_switch("luminosity", spectra_colour::luminosity, switches_.luminosity);
  tooltip("How bright the eye sees each wavelength: CIE 1931 y, 1 at 555 nm");
  draw_switch("u", spectra_colour::u, switches_.u);
  tooltip("How much a wavelength matters: (4.15) of the thesis where the effort is importance");
  draw_switch("iterations", spectra_colour::iterations, switches_.iterations);
  places_.note("iterations", "How many of the preset's passes each cluster has, in the plot below");
  ImGui::PushID("reflectances"); // a material may be called "light"
  for (const ReflectanceCurve& curve : spectra.reflectances) {
    bool on = !switches_.hidden.contains(curve.material);
    const bool changed = draw_switch(curve.material, spectra_colour::of(curve.srgb), on);
    places_.note("reflectance " + curve.material,
                 fmt::format("Reflectance of {}, in its colour under D65", curve.material));
    if (!changed) continue;
    if (on)
      switches_.hidden.erase(curve.material);
    else
      switches_.hidden.insert(curve.material);
  }
  ImGui::PopID();
  same_line_if_room(4 * em());
  if (places_.button("Copy", "copy", "Every curve as CSV, a row a wavelength"))
    ImGui::SetClipboardText(to_csv(maker_.spectra()).c_str());
}

void SpectraPanel::draw_plot(const Context& context, float height) {
  SpectraPlotContents contents{&maker_.spectra(), &switches_, nullptr, light_, editor_.marked()};
  if (!context.preset()->scene.lights.empty()) contents.edited = &spectrum_;
  follow_rows(context, plot_.draw(contents, axis_, height));
}

void SpectraPanel::follow_rows(const Context& context, const RowGesture& gesture) {
  const auto edit = editor_.follow(gesture, spectrum_.table, row_rules(spectrum_), context.commands);
  if (!edit) return;
  const auto change = [&](preset::Preset& p) {
    p.scene.lights[light_].spectrum = spectrum_;
    p.scene.lights[light_].spectrum.table = edit->rows;
  };
  context.edit(fmt::format("{} of light {}", edit->label, light_ + 1), change, edit->gesture, edit->live);
}

/// What the clusters cost, and what of brute force that is.
void SpectraPanel::draw_numbers() const {
  const Spectra& s = maker_.spectra();
  if (!s.why_no_u.empty()) {
    draw_wrapped(colour::note, "No u: " + s.why_no_u);
    return;
  }
  const std::int64_t sum = s.iterations();
  ImGui::PushTextWrapPos(0);
  if (sum == 0)
    ImGui::TextUnformatted("No light: no iterations");
  else
    ImGui::TextUnformatted(fmt::format("{} in {}, {} times fewer than the {} of 401 wavelengths x {}",
                                       counted(sum, "iteration"), counted(s.clusters.size(), "cluster"),
                                       times(s.brute_force(), sum), s.brute_force(), s.passes)
                               .c_str());
  tooltip(fmt::format("{} times fewer by clusters, {} by what divides the work.\nPhoton maps give a cluster so many "
                      "passes; splats divide photons in this proportion.",
                      times(s.brute_force(), std::max<std::int64_t>(s.equal_effort(), 1)),
                      times(s.equal_effort(), std::max<std::int64_t>(sum, 1))));
  ImGui::PopTextWrapPos();
}

/// The sum of (4.15), material by material.
void SpectraPanel::draw_surroundings() const {
  const Spectra& s = maker_.spectra();
  if (s.importance.surroundings.empty()) return;
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("surroundings", 4, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("seen from the glass", ImGuiTableColumnFlags_WidthStretch, 2);
  for (const char* column : {"part", "L*", "part x L*"})
    ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  const std::array<const char*, 4> help{"What the caustic objects see around them, by material",
                                        "Part of the rays from the glass that hit it; 100 % each without geometry",
                                        "Lightness of the material under the scene's light: 0 black, 100 white",
                                        "Its weight in u, (4.15) of the thesis"};
  for (int column = 0; column < 4; ++column) {
    ImGui::TableSetColumnIndex(column);
    ImGui::TableHeader(ImGui::TableGetColumnName(column));
    tooltip(help[static_cast<std::size_t>(column)]);
  }
  for (const photons::Surrounding& seen : s.importance.surroundings) {
    ImGui::TableNextRow();
    cell(s.materials[static_cast<std::size_t>(seen.material)]);
    cell(fmt::format("{:.1f} %", 100 * seen.share));
    cell(fmt::format("{:.1f}", seen.lightness));
    cell(fmt::format("{:.1f}", seen.share * seen.lightness));
  }
  ImGui::EndTable();
}

} // namespace nephroid::ui
