// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/dispersion/panel.h"

#include "base/counted.h"
#include "photons/describe_settings.h"
#include "preset/choices.h"
#include "spectral/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using Type = preset::Dispersion::Type;

constexpr double far_nm = 200; ///< control points farther beyond the 401 wavelengths do not widen the axis

/// Where n comes from, in a few words.
std::string source_text(const preset::Dispersion& dispersion, const GlassCurve& curve) {
  const std::string range = fmt::format("{:.6g}..{:.6g} nm", curve.data_nm[0], curve.data_nm[1]);
  switch (dispersion.type) {
  case Type::constant: return fmt::format("constant: n = {:.6g} at every wavelength", dispersion.n);
  case Type::file:
    return fmt::format("file {}{}", std::filesystem::path(dispersion.file).filename().string(),
                       curve.data_nm[1] > 0 ? ": " + range : "");
  case Type::sellmeier: return "formula: Sellmeier with " + counted(dispersion.b.size(), "term");
  case Type::cauchy: return "formula: Cauchy with " + counted(dispersion.coefficients.size(), "coefficient");
  case Type::table: return fmt::format("table of {}, {}", counted(dispersion.table.size(), "row"), range);
  case Type::points: break;
  }
  return fmt::format("{} control points, {}", dispersion.table.size(), range);
}

std::string spread_text(const Spread& spread) {
  return fmt::format("{:.3f} / {:.3f}", spread.mean_deg, spread.greatest_deg);
}

} // namespace

void DispersionPanel::draw(const Context& context) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  const std::vector<std::string> names = dielectrics(*context.preset());
  if (names.empty()) return draw_hint(colour::quiet_text, corner, size, "No material of this preset is a dielectric");
  follow(context);
  if (constexpr float edge = 6; size.x > (edge + 20) * em()) {
    pictures_.draw(context.balls, shown_, edge * em(), places_, "picture");
    ImGui::SameLine();
  }
  ImGui::BeginGroup();
  draw_toolbar(context, names);
  std::string source = source_text(dispersion_, model_.curve());
  if (!fitted_text_.empty() && dispersion_ == fitted_) source += "; " + fitted_text_;
  draw_wrapped(colour::quiet_text, source);
  if (!model_.curve().note.empty()) draw_wrapped(colour::note, model_.curve().note);
  ImGui::EndGroup();
  draw_points_row(context);
  draw_plot(context);
  const float top = ImGui::GetCursorPosY();
  if (model_.error().empty()) {
    draw_methods(context);
    draw_bias(context);
  } else
    draw_wrapped(colour::error, model_.error());
  below_plot_ = ImGui::GetCursorPosY() - top;
}

/// Takes over what the preset says now. Another material leaves no point selected.
void DispersionPanel::follow(const Context& context) {
  const preset::Preset& preset = *context.preset();
  const std::string material = shown_dielectric(preset, context.view_state.material);
  model_.update(preset, material);
  dispersion_ = preset.scene.materials.at(material).dispersion;
  points_ = sorted_points(dispersion_);
  const bool another = std::exchange(shown_, material) != material;
  editor_.keep(points_.size());
  if (!another) return;
  editor_.unmark();
  fitted_text_.clear();
}

void DispersionPanel::draw_toolbar(const Context& context, const std::vector<std::string>& names) {
  ImGui::SetNextItemWidth(9 * em());
  {
    Combo list("##material", shown_);
    for (const std::string& name : names)
      if (list.entry(name, name == shown_)) context.push(command::ChooseMaterial{name});
  }
  tooltip("The dielectric that is shown; files that are dropped on the window are loaded into it");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  const std::string file = dispersion_.type == Type::file ? dispersion_.file : std::string();
  if (const auto glass = glasses_.draw("glass", MaterialChoice::Kind::glass, file, context.tasks, places_))
    context.push(command::LoadDispersion{*glass});
  ImGui::SameLine();
  const bool editable = dispersion_.type == Type::points;
  ImGui::BeginDisabled(editable || !model_.curve().error.empty());
  if (places_.button("Make editable", "Make editable")) make_editable(context);
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled | ImGuiHoveredFlags_DelayNormal))
    ImGui::SetTooltip("%s",
                      editable ? "It is made of control points: drag them"
                      : model_.curve().has_k
                          ? "Control points that reproduce n at 380..780 nm. They have no k: the glass will not absorb"
                          : "Control points that reproduce n at 380..780 nm");
}

void DispersionPanel::draw_points_row(const Context& context) {
  if (ImGui::Button("All")) {
    const bool has = !points_.empty();
    axis_.show_all(std::max(has ? points_.front()[0] : optics::first_nm, optics::first_nm - far_nm),
                   std::min(has ? points_.back()[0] : optics::last_nm, optics::last_nm + far_nm));
  }
  tooltip("The whole range; the wheel zooms, a drag moves. The wavelengths are shared with the other plots.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!model_.error().empty());
  places_.checkbox("Sorted", &sorted_, "Sorted", "Wavelengths in the order in which they are clustered: by falling n");
  ImGui::EndDisabled();
  if (points_.empty() || sorted_) return;
  ImGui::SameLine();
  places_.checkbox("Snap", &snap_, "Snap",
                   fmt::format("Dragged points keep to a grid: 1 nm, and {:.6g} of n at this zoom", plot_.grid()[1]));
  ImGui::SameLine();
  const double nm = middle_of_widest_gap(points_);
  const auto index =
      static_cast<std::size_t>(std::clamp(std::lround(nm) - optics::first_nm, 0L, optics::wavelength_count - 1L));
  const double n = model_.curve().error.empty() ? model_.curve().n[index] : points_.front()[1];
  follow_rows(context, draw_row_buttons({nm, n}, editor_.marked(), places_));
}

void DispersionPanel::draw_plot(const Context& context) {
  const float free = ImGui::GetContentRegionAvail().y - ImGui::GetStyle().ItemSpacing.y;
  const float below = below_plot_ > 0 ? below_plot_ : 11 * em();
  const bool absorbs = context.preset()->scene.materials.at(shown_).absorption;
  RowGesture gesture =
      plot_.draw({&model_, points_, editor_.marked(), sorted_, absorbs}, axis_, std::max(free - below, 10 * em()));
  if (snap_) gesture.to = snapped(gesture.to, plot_.grid());
  follow_rows(context, gesture);
}

void DispersionPanel::follow_rows(const Context& context, const RowGesture& gesture) {
  if (const auto edit = editor_.follow(gesture, points_, point_rules, context.commands)) edit_points(context, *edit);
}

void DispersionPanel::edit_points(const Context& context, const RowsEdit& edit) const {
  const auto change = [&](preset::Preset& p) {
    p.scene.materials.at(shown_).dispersion = with_points(dispersion_, edit.rows);
  };
  context.edit(fmt::format("{} of {}", edit.label, shown_), change, edit.gesture, edit.live);
}

void DispersionPanel::make_editable(const Context& context) {
  const FittedPoints fitted = fit_points(model_.curve().n);
  fitted_ = with_points(dispersion_, fitted.points);
  fitted_text_ = fmt::format("they reproduce {} within {:.1g} of n", model_.curve().name, fitted.greatest_deviation);
  edit_points(context, {"make control points", fitted.points});
  context.note(fmt::format("{} is made of {} control points now: {}", shown_, fitted.points.size(), fitted_text_));
  editor_.unmark();
}

/// The run's method is the one that is not greyed.
void DispersionPanel::draw_methods(const Context& context) const {
  if (!ImGui::BeginTable("methods", 5, ImGuiTableFlags_SizingStretchProp)) return;
  heading_cell("Method", "How wavelengths are grouped (spectral.method); the run's is not greyed");
  heading_cell("Clusters", "Groups of wavelengths that share one path each");
  heading_cell("Saving", "401 wavelengths / clusters: so many times fewer paths than one for each wavelength");
  heading_cell("At 45 deg", "By how many degrees the refraction angle differs inside a cluster at 45 degrees of "
                            "incidence: mean over the wavelengths / "
                            "greatest");
  heading_cell("0..89 deg",
               "The same as the mean over 0 to 89 degrees of incidence, which spectral.threshold_deg is about");
  for (const auto& choice : preset::choices<photons::ClusterMethod>) {
    const ClusterFigures& figures = model_.figures(choice.value);
    const std::string name(choice.name == "brute_force" ? "brute force" : choice.name);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(spectral::settings(*context.preset()).method != choice.value);
    ImGui::TextUnformatted(name.c_str());
    tooltip(std::string(choice.sentence));
    cell(fmt::format("{}", figures.clustering.clusters.size()));
    cell(fmt::format("{:.3g}", figures.saving));
    cell(spread_text(figures.at_45));
    cell(spread_text(figures.mean_over_angles));
    ImGui::EndDisabled();
  }
  ImGui::EndTable();
}

void DispersionPanel::draw_bias(const Context& context) const {
  const Spread& spread = model_.chosen().at_45;
  std::string text;
  if (spectral::settings(*context.preset()).jitter)
    text = "Bias 0: each photon takes one wavelength of its cluster";
  else if (spread.greatest_deg == 0)
    text = "Bias 0: no cluster bends two rays alike that differ";
  else
    text = fmt::format("Bias: rays of a cluster go one way that differ by up to {:.2g} degrees", spread.greatest_deg);
  draw_wrapped(colour::quiet_text, text);
  if (const auto clusters = model_.clusters_of_run();
      clusters && *clusters != model_.chosen().clustering.clusters.size())
    draw_wrapped(colour::quiet_text,
                 fmt::format("The run has {}: those of all its glasses and of step_nm", counted(*clusters, "cluster")));
}

} // namespace nephroid::ui
