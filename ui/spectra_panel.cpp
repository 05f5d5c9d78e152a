// SPDX-License-Identifier: Apache-2.0
#include "ui/spectra_panel.h"

#include "optics/spectrum.h"
#include "preset/describe_limits.h"
#include "ui/choice_combo.h"
#include "ui/theme.h"
#include "ui/wavelength_axis.h"
#include "ui/widgets.h"
#include "ui/workbench.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using Effort = preset::Spectral::Effort;
using Type = preset::LightSpectrum::Type;

constexpr std::size_t most_seen = 6; ///< materials around the glass that the table shows without scrolling

float em() { return ImGui::GetFontSize(); }

/// Goes on in the line where `width` still fits in it.
void same_line_if_room(float width)
{
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void sentence(std::uint32_t colour, const std::string& text)
{
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// A box with a piece of its curve: the switches are the plot's legend. first: it begins a line.
bool draw_switch(const std::string& name, std::uint32_t colour, bool& on, bool first = false)
{
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
  if (spectra_colour::is_dark(colour)) list.AddRect({x - 1, y - half - 1}, {x + swatch + 1, y + half + 1}, spectra_colour::rim);
  return changed;
}

std::string times(std::int64_t more, std::int64_t fewer)
{
  return fmt::format("{:.3g}", static_cast<double>(more) / static_cast<double>(fewer));
}

} // namespace

void SpectraPanel::draw(const Workbench& workbench, Commands& commands)
{
  if (!workbench.preset()) {
    draw_hint(ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail(),
              "Open a preset: its light, what reflects it and what the eye makes of it");
    return;
  }
  places_.clear();
  maker_.update(*workbench.preset(), workbench.seen_by_glass());
  choose_light(*workbench.preset());
  draw_light(workbench, commands);
  draw_switches();
  draw_copy();
  const Spectra& spectra = maker_.spectra();
  const float line = ImGui::GetTextLineHeight(), cell = line + 2 * ImGui::GetStyle().CellPadding.y;
  const auto seen = spectra.importance.surroundings.size();
  const float table = seen == 0 ? 0 : static_cast<float>(std::min(seen, most_seen) + 1) * cell + ImGui::GetStyle().ItemSpacing.y;
  const float below = 2 * line + ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().ItemSpacing.y + table;
  draw_plot(workbench, commands, std::max(ImGui::GetContentRegionAvail().y - below, 16 * em()));
  draw_numbers();
  draw_effort(workbench, commands);
  draw_surroundings();
}

/// The edited light of another preset, or of one with fewer lights, is the first.
void SpectraPanel::choose_light(const preset::Preset& preset)
{
  if (source_ != preset.source || light_ >= preset.scene.lights.size()) light_ = 0;
  source_ = preset.source;
  spectrum_ = preset.scene.lights.empty() ? preset::LightSpectrum{} : sorted(preset.scene.lights[light_].spectrum);
  if (row_ && (!has_rows(spectrum_) || *row_ >= spectrum_.table.size())) row_.reset();
}

void SpectraPanel::draw_light(const Workbench& workbench, Commands& commands)
{
  if (workbench.preset()->scene.lights.empty()) {
    sentence(colour::note, "The scene has no light");
    return;
  }
  draw_light_choice(*workbench.preset());
  draw_spectrum_controls(workbench, commands);
  if (has_rows(spectrum_)) draw_row_controls(workbench, commands);
  if (const std::string& error = maker_.spectra().lights[light_].error; !error.empty()) sentence(colour::error, error);
}

void SpectraPanel::draw_light_choice(const preset::Preset& preset)
{
  const auto name = [&](std::size_t i) { return fmt::format("Light {}, {}", i + 1, preset::word(preset.scene.lights[i].type)); };
  if (preset.scene.lights.size() == 1) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Light");
    return;
  }
  ImGui::SetNextItemWidth(10 * em());
  if (ImGui::BeginCombo("##light", name(light_).c_str())) {
    for (std::size_t i = 0; i < preset.scene.lights.size(); ++i)
      if (ImGui::Selectable(name(i).c_str(), i == light_)) {
        light_ = i;
        row_.reset();
        spectrum_ = sorted(preset.scene.lights[i].spectrum);
      }
    ImGui::EndCombo();
  }
  note_place("light");
}

void SpectraPanel::draw_spectrum_controls(const Workbench& workbench, Commands& commands)
{
  same_line_if_room(8 * em());
  Type type = spectrum_.type;
  if (choice_combo("##type", type)) {
    gestures_.begin();
    row_.reset();
    edit_spectrum(workbench, as_type(spectrum_, type), "kind of spectrum", false, commands);
  }
  note_place("type");
  same_line_if_room(7 * em());
  preset::LightSpectrum edited = spectrum_;
  if (spectrum_.type == Type::illuminant) {
    ImGui::SetNextItemWidth(6 * em());
    if (ImGui::BeginCombo("##illuminant", edited.illuminant.c_str(), ImGuiComboFlags_HeightLarge)) {
      for (const std::string& name : optics::illuminant_names()) {
        if (ImGui::Selectable(name.c_str(), name == spectrum_.illuminant)) {
          edited.illuminant = name;
          gestures_.begin();
          edit_spectrum(workbench, edited, "illuminant " + name, false, commands);
        }
        note_place("illuminant " + name);
      }
      ImGui::EndCombo();
    }
    note_place("illuminant");
  } else if (spectrum_.type == Type::blackbody) {
    ImGui::SetNextItemWidth(9 * em());
    auto kelvin = static_cast<float>(edited.temperature_k);
    constexpr ImGuiSliderFlags flags = ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat;
    const bool changed = ImGui::SliderFloat("##kelvin", &kelvin, 1000, 20000, "%.0f K", flags);
    follow_widget(commands);
    if (changed) {
      edited.temperature_k = std::clamp(std::round(static_cast<double>(kelvin)), 300.0, 1e6);
      edit_spectrum(workbench, edited, "temperature", true, commands);
    }
    note_place("temperature");
  } else {
    ImGui::TextDisabled("%s", fmt::format("{} {}", spectrum_.table.size(), spectrum_.table.size() == 1 ? "row" : "rows").c_str());
    ImGui::SetItemTooltip("Drag a point. A double click adds one, a click with the right button removes one.");
  }
}

/// The marked row in numbers, and buttons for what the mouse does too.
void SpectraPanel::draw_row_controls(const Workbench& workbench, Commands& commands)
{
  preset::LightSpectrum edited = spectrum_;
  if (row_) {
    const double before = edited.table[*row_][1], unit = largest_power(spectrum_);
    PowerRow to = edited.table[*row_];
    ImGui::SetNextItemWidth(6.5f * em());
    bool changed = ImGui::DragScalar("##nm", ImGuiDataType_Double, &to[0], 0.5f, nullptr, nullptr, "%.1f nm");
    follow_widget(commands);
    note_place("wavelength");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6.5f * em());
    changed |= ImGui::DragScalar("##power", ImGuiDataType_Double, &to[1], static_cast<float>(0.005 * unit), nullptr, nullptr, "%.4g");
    ImGui::SetItemTooltip("Relative power");
    follow_widget(commands);
    note_place("power");
    ImGui::SameLine();
    if (changed) {
      move_row(edited, *row_, to);
      edit_spectrum(workbench, edited, to[1] == before ? "wavelength of a row" : "power of a row", true, commands);
    }
  }
  if (ImGui::Button("Add")) {
    gestures_.begin();
    row_ = add_in_widest_gap(edited);
    edit_spectrum(workbench, edited, "add a row", false, commands);
  }
  note_place("add");
  ImGui::SetItemTooltip("One more row, in the widest gap; a double click in the plot adds one there.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!row_ || !can_remove_row(spectrum_));
  const bool deleted = row_ && ImGui::IsWindowFocused() && !ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(ImGuiKey_Delete, false);
  if (ImGui::Button("Remove") || deleted) follow({RowGesture::Kind::remove, *row_, {}}, workbench, commands);
  note_place("remove");
  ImGui::EndDisabled();
  if (!row_) {
    same_line_if_room(12 * em());
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("click a point to mark it");
  }
}

void SpectraPanel::draw_switches()
{
  const Spectra& spectra = maker_.spectra();
  draw_switch("light", spectra_colour::light, switches_.light, true);
  draw_switch("luminosity", spectra_colour::luminosity, switches_.luminosity);
  draw_switch("u", spectra_colour::u, switches_.u);
  ImGui::SetItemTooltip("How much a wavelength matters: (4.15) of the thesis where the effort is importance");
  draw_switch("iterations", spectra_colour::iterations, switches_.iterations);
  note_place("iterations");
  ImGui::PushID("reflectances"); // a material may be called "light"
  for (const ReflectanceCurve& curve : spectra.reflectances) {
    bool on = !switches_.hidden.contains(curve.material);
    const bool changed = draw_switch(curve.material, spectra_colour::of(curve.srgb), on);
    ImGui::SetItemTooltip("%s", fmt::format("Reflectance of {}, in its colour under D65", curve.material).c_str());
    note_place("reflectance " + curve.material);
    if (!changed) continue;
    if (on)
      switches_.hidden.erase(curve.material);
    else
      switches_.hidden.insert(curve.material);
  }
  ImGui::PopID();
}

void SpectraPanel::draw_copy()
{
  same_line_if_room(4 * em());
  if (ImGui::Button("Copy")) ImGui::SetClipboardText(to_csv(maker_.spectra()).c_str());
  note_place("copy");
  ImGui::SetItemTooltip("Every curve as CSV, a row a wavelength");
}

void SpectraPanel::draw_plot(const Workbench& workbench, Commands& commands, float height)
{
  SpectraPlotContents contents{&maker_.spectra(), &switches_, nullptr, light_, row_};
  if (!workbench.preset()->scene.lights.empty()) contents.edited = &spectrum_;
  follow(plot_.draw(contents, axis_, height), workbench, commands);
}

void SpectraPanel::follow(const RowGesture& gesture, const Workbench& workbench, Commands& commands)
{
  using Kind = RowGesture::Kind;
  preset::LightSpectrum edited = spectrum_;
  switch (gesture.kind) {
  case Kind::none:
    return;
  case Kind::take:
    row_ = gesture.row;
    gestures_.begin();
    return;
  case Kind::move:
    move_row(edited, gesture.row, gesture.to);
    edit_spectrum(workbench, edited, "drag a row", true, commands);
    return;
  case Kind::let_go:
    commands.push_back(command::EndGesture{});
    return;
  case Kind::add:
    gestures_.begin();
    if (const auto added = add_row(edited, gesture.to)) row_ = added;
    edit_spectrum(workbench, edited, "add a row", false, commands);
    return;
  case Kind::remove:
    if (!can_remove_row(edited)) return;
    gestures_.begin();
    remove_row(edited, gesture.row);
    row_.reset();
    edit_spectrum(workbench, edited, "remove a row", false, commands);
    return;
  }
}

/// What the clusters cost, and what of brute force that is.
void SpectraPanel::draw_numbers() const
{
  const Spectra& s = maker_.spectra();
  if (!s.why_no_u.empty()) {
    sentence(colour::note, "No u: " + s.why_no_u);
    return;
  }
  const std::int64_t sum = s.iterations();
  ImGui::PushTextWrapPos(0);
  if (sum == 0)
    ImGui::TextUnformatted("No light: no iterations");
  else
    ImGui::TextUnformatted(fmt::format("{} iterations in {} clusters, {} times fewer than the {} of 401 wavelengths x {}", sum,
                                       s.clusters.size(), times(s.brute_force(), sum), s.brute_force(), s.passes)
                               .c_str());
  ImGui::SetItemTooltip(
      "%s", fmt::format("{} times fewer by clusters, {} by what deals out the work.\nPhoton maps give a cluster so many passes; "
                        "splats deal photons out in this proportion.",
                        times(s.brute_force(), std::max<std::int64_t>(s.equal_effort(), 1)),
                        times(s.equal_effort(), std::max<std::int64_t>(sum, 1)))
                .c_str());
  ImGui::PopTextWrapPos();
}

void SpectraPanel::draw_effort(const Workbench& workbench, Commands& commands)
{
  preset::Preset edited = *workbench.preset();
  preset::Spectral& settings = edited.spectral;
  const auto push = [&](const char* label) { commands.push_back(command::Edit{label, edited, gestures_.begin()}); };
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Effort by");
  ImGui::SameLine();
  if (choice_combo("##effort", settings.effort)) push("effort");
  note_place("effort");
  if (settings.effort != Effort::importance && settings.effort != Effort::radziszewski) return;
  same_line_if_room(7 * em());
  if (choice_combo("##cluster", settings.importance.cluster)) push("importance of a cluster");
  note_place("importance of a cluster");
  if (settings.effort != Effort::importance) return;
  same_line_if_room(7 * em());
  if (ImGui::Checkbox("geometry", &settings.importance.geometry)) push("importance by geometry");
  ImGui::SetItemTooltip("Weigh materials by how much of them the caustic objects see");
  note_place("geometry");
}

/// The sum of (4.15), material by material.
void SpectraPanel::draw_surroundings() const
{
  const Spectra& s = maker_.spectra();
  if (s.importance.surroundings.empty()) return;
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("surroundings", 4, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("seen from the glass", ImGuiTableColumnFlags_WidthStretch, 2);
  for (const char* column : {"part", "L*", "part x L*"}) ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableHeadersRow();
  for (const spectral::Surrounding& seen : s.importance.surroundings) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(s.materials[static_cast<std::size_t>(seen.material)].c_str());
    for (const std::string& cell : {fmt::format("{:.1f} %", 100 * seen.share), fmt::format("{:.1f}", seen.lightness),
                                    fmt::format("{:.1f}", seen.share * seen.lightness)}) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(cell.c_str());
    }
  }
  ImGui::EndTable();
}

void SpectraPanel::edit_spectrum(const Workbench& workbench, const preset::LightSpectrum& spectrum, const std::string& label, bool live,
                                 Commands& commands) const
{
  if (spectrum == spectrum_) return;
  preset::Preset edited = *workbench.preset();
  edited.scene.lights[light_].spectrum = spectrum;
  commands.push_back(command::Edit{label, std::move(edited), gestures_.number(), live});
}

void SpectraPanel::follow_widget(Commands& commands)
{
  if (ImGui::IsItemActivated()) gestures_.begin();
  if (ImGui::IsItemDeactivated()) commands.push_back(command::EndGesture{});
}

void SpectraPanel::note_place(const std::string& widget)
{
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[widget] = {(low.x + high.x) / 2, (low.y + high.y) / 2};
}

std::optional<std::array<double, 2>> SpectraPanel::place_of(const std::string& widget) const
{
  const auto found = places_.find(widget);
  if (found == places_.end()) return std::nullopt;
  return found->second;
}

} // namespace nephroid::ui
