// SPDX-License-Identifier: Apache-2.0
#include "ui/dispersion/panel.h"

#include "base/counted.h"
#include "ui/state/workbench.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/wavelength_axis.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace nephroid::ui {
namespace {

using Type = preset::Dispersion::Type;

constexpr double far_nm = 200; ///< control points farther beyond the 401 wavelengths do not widen the axis

/// Where n comes from, in a few words.
std::string source_text(const preset::Dispersion& dispersion, const GlassCurve& curve)
{
  const std::string range = fmt::format("{:.6g}..{:.6g} nm", curve.data_nm[0], curve.data_nm[1]);
  switch (dispersion.type) {
  case Type::constant:
    return fmt::format("constant: n = {:.6g} at every wavelength", dispersion.n);
  case Type::file:
    return fmt::format("file {}{}", std::filesystem::path(dispersion.file).filename().string(), curve.data_nm[1] > 0 ? ": " + range : "");
  case Type::sellmeier:
    return "formula: Sellmeier with " + counted(dispersion.b.size(), "term");
  case Type::cauchy:
    return "formula: Cauchy with " + counted(dispersion.coefficients.size(), "coefficient");
  case Type::table:
    return fmt::format("table of {}, {}", counted(dispersion.table.size(), "row"), range);
  case Type::points:
    break;
  }
  return fmt::format("{} control points, {}", dispersion.table.size(), range);
}

} // namespace

void DispersionPanel::draw(const Workbench& workbench, Commands& commands)
{
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  if (!workbench.preset()) return draw_hint(corner, size, "Open a preset: the dispersion of its glass, and the wavelength clusters");
  const std::vector<std::string> names = dielectrics(*workbench.preset());
  if (names.empty()) return draw_hint(corner, size, "No material of this preset is a dielectric");
  follow(workbench);
  const Frame frame{workbench, *workbench.preset(), workbench.preset()->scene.materials.at(shown_), commands};
  draw_toolbar(frame, names);
  draw_source(frame);
  draw_points_row(frame);
  draw_plot(frame);
  const float top = ImGui::GetCursorPosY();
  if (model_.error().empty()) {
    draw_methods(frame);
    draw_bias(frame);
  } else
    draw_wrapped(colour::error, model_.error());
  below_plot_ = ImGui::GetCursorPosY() - top;
}

/// Takes over what the preset says now. Another material leaves no point selected.
void DispersionPanel::follow(const Workbench& workbench)
{
  const preset::Preset& preset = *workbench.preset();
  const std::string material = shown_dielectric(preset, workbench.material());
  model_.update(preset, material);
  points_ = sorted_points(preset.scene.materials.at(material).dispersion);
  const bool another = material != shown_;
  shown_ = material;
  editor_.keep(points_.size());
  if (!another) return;
  editor_.unmark();
  fitted_text_.clear();
}

void DispersionPanel::draw_toolbar(const Frame& frame, const std::vector<std::string>& names)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
  if (ImGui::BeginCombo("##material", shown_.c_str())) {
    for (const std::string& name : names)
      if (ImGui::Selectable(name.c_str(), name == shown_)) frame.commands.push_back(command::ChooseMaterial{name});
    ImGui::EndCombo();
  }
  ImGui::SetItemTooltip("The dielectric that is shown; files that are dropped on the window are loaded into it");
  ImGui::SameLine();
  const bool editable = frame.material.dispersion.type == Type::points;
  ImGui::BeginDisabled(editable || !model_.curve().error.empty());
  if (ImGui::Button("Make editable")) make_editable(frame);
  places_.note("Make editable");
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled | ImGuiHoveredFlags_DelayNormal))
    ImGui::SetTooltip("%s", editable ? "It is made of control points: drag them"
                            : model_.curve().has_k
                                ? "Control points that reproduce n at 380..780 nm. They have no k: the glass will not absorb"
                                : "Control points that reproduce n at 380..780 nm");
}

void DispersionPanel::draw_source(const Frame& frame) const
{
  const preset::Dispersion& dispersion = frame.material.dispersion;
  std::string text = source_text(dispersion, model_.curve());
  if (!fitted_text_.empty() && dispersion == fitted_) text += "; " + fitted_text_;
  draw_wrapped(colour::quiet_text, text);
  if (!model_.curve().note.empty()) draw_wrapped(colour::note, model_.curve().note);
}

void DispersionPanel::draw_points_row(const Frame& frame)
{
  if (ImGui::Button("All")) {
    const bool has = !points_.empty();
    axis_.show_all(std::max(has ? points_.front()[0] : optics::first_nm, optics::first_nm - far_nm),
                   std::min(has ? points_.back()[0] : optics::last_nm, optics::last_nm + far_nm));
  }
  ImGui::SetItemTooltip("The whole range; the wheel zooms, a drag moves. The wavelengths are shared with the other plots.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!model_.error().empty());
  ImGui::Checkbox("Sorted", &sorted_);
  places_.note("Sorted");
  ImGui::EndDisabled();
  ImGui::SetItemTooltip("Wavelengths in the order in which they are clustered: by falling n");
  if (points_.empty() || sorted_) return;
  ImGui::SameLine();
  ImGui::Checkbox("Snap", &snap_);
  places_.note("Snap");
  ImGui::SetItemTooltip("%s", fmt::format("Dragged points keep to a grid: 1 nm, and {:.6g} of n at this zoom", plot_.grid()[1]).c_str());
  ImGui::SameLine();
  if (ImGui::Button("Add")) {
    const double nm = middle_of_widest_gap(points_);
    const auto index = static_cast<std::size_t>(std::clamp(std::lround(nm) - optics::first_nm, 0L, optics::wavelength_count - 1L));
    const double n = model_.curve().error.empty() ? model_.curve().n[index] : points_.front()[1];
    edit_points(frame, editor_.add(points_, {nm, n}, point_rules, frame.commands));
  }
  places_.note("Add");
  ImGui::SetItemTooltip("A control point on the curve in the widest gap; a double click on the plot adds one at the mouse");
  ImGui::SameLine();
  ImGui::BeginDisabled(!editor_.marked());
  if (ImGui::Button("Remove") || (editor_.marked() && delete_pressed()))
    edit_points(frame, editor_.remove(points_, *editor_.marked(), point_rules, frame.commands));
  places_.note("Remove");
  ImGui::EndDisabled();
  ImGui::SetItemTooltip("The selected point; Delete, or a right click on a point, does the same");
}

void DispersionPanel::draw_plot(const Frame& frame)
{
  const float em = ImGui::GetFontSize(), free = ImGui::GetContentRegionAvail().y - ImGui::GetStyle().ItemSpacing.y;
  const float below = below_plot_ > 0 ? below_plot_ : 11 * em;
  const DispersionContents contents{&model_, points_, editor_.marked(), sorted_, frame.material.absorption};
  RowGesture gesture = plot_.draw(contents, axis_, std::max(free - below, 10 * em));
  gesture.to = place(gesture.to);
  edit_points(frame, editor_.follow(gesture, points_, point_rules, frame.commands));
}

/// On the grid, if it is wanted; else in figures that a person can read in the preset, finer than a pixel.
ControlPoint DispersionPanel::place(const ControlPoint& mouse) const
{
  const ControlPoint to = snap_ ? snapped(mouse, plot_.grid()) : mouse;
  return {std::round(to[0] * 100) / 100, std::round(to[1] * 1e6) / 1e6};
}

void DispersionPanel::edit_points(const Frame& frame, const std::optional<RowsEdit>& edit) const
{
  if (!edit) return;
  preset::Preset edited = with_dispersion(frame.preset, shown_, with_points(frame.material.dispersion, edit->rows));
  frame.commands.push_back(command::Edit{fmt::format("{} of {}", edit->label, shown_), std::move(edited), edit->gesture, edit->live});
}

void DispersionPanel::make_editable(const Frame& frame)
{
  FittedPoints fitted = fit_points(model_.curve().n);
  fitted_text_ = fmt::format("they reproduce {} within {:.1g} of n", model_.curve().name, fitted.greatest_deviation);
  const std::string note = fmt::format("{} is made of {} control points now: {}", shown_, fitted.points.size(), fitted_text_);
  edit_points(frame, RowsEdit{"make control points", std::move(fitted.points)});
  fitted_ = std::get<command::Edit>(frame.commands.back()).preset.scene.materials.at(shown_).dispersion;
  frame.commands.push_back(command::Report{note, false});
  editor_.unmark();
}

} // namespace nephroid::ui
