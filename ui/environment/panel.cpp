// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/panel.h"

#include "base/counted.h"
#include "environment/describe_settings.h"
#include "environment/settings.h"
#include "measure/run_curves.h"

#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace nephroid::ui {
namespace {

constexpr double to_percent = 100;
constexpr double room = 1.3; ///< beside the outermost points, as a factor

void plot_method(const std::string& name, const Quality& errors) {
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

bool is_engine_2(const preset::Preset& preset) { return &preset.settings.type() == &environment::settings_type(); }

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

/// What is said of the region under the mouse. number: from 0; lights: how many regions are lights.
std::string text_of(const RegionFigures& f, std::size_t number, std::size_t lights) {
  std::string text = number < lights
                         ? fmt::format("Light {}\n{:.4g} W/m^2, {} of all\n", number + 1, f.flux, percent(f.share))
                         : std::string("Too dark to be a light of its own\n");
  text += fmt::format("azimuth {:.1f}, elevation {:.1f} degrees\n{:.3g} sr", f.azimuth_deg, f.elevation_deg,
                      f.solid_angle_sr);
  if (number < lights) text += fmt::format("\ncolour #{:02x}{:02x}{:02x}", f.colour[0], f.colour[1], f.colour[2]);
  if (f.occluded) text += fmt::format("\n{} hidden", percent(*f.occluded));
  return text;
}

} // namespace

std::array<double, 2> error_range(const ShownMap& shown) {
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

void QualityPlot::draw(const ShownMap& shown, float height) {
  if (!begin_plot("##quality", height)) return;
  ImPlot::SetupAxes("lights", "irradiance error (%)");
  ImPlot::SetupAxisScale(ImAxis_X1, ImPlotScale_Log10);
  ImPlot::SetupAxisScale(ImAxis_Y1, ImPlotScale_Log10);
  const double lights = shown.cut ? shown.cut->settings.lights : quality_lights.front();
  const std::array<double, 2> range = error_range(shown);
  ImPlot::SetupAxesLimits(quality_lights.front() / room, std::max<double>(quality_lights.back(), lights) * room,
                          range[0], range[1], ImPlotCond_Always);
  set_up_ticks(ImAxis_X1, {6, 8, 12, 16, 24, 32, 48, 64, 128, 256, 1024, 4096});
  if (const std::vector<double> ticks = measure::round_levels(range[0], range[1]); ticks.size() > 1)
    set_up_ticks(ImAxis_Y1, ticks);
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

bool EnvironmentPanel::serves(const preset::Preset& preset) { return preset.scene.environment || is_engine_2(preset); }

void EnvironmentPanel::draw(const Context& context) {
  places_.clear();
  const preset::Preset& preset = *context.preset();
  if (!preset.scene.environment) {
    action_button("Open map...", context);
    places_.note("open map");
    draw_hint(
        colour::quiet_text, ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail(),
        "The preset has no environment: open a latitude-longitude picture (.hdr, .exr), drop one on the window, or add "
        "scene.environment in Parameters");
    return;
  }
  follow(context);
  draw_toolbar(context);
  if (cuts_)
    draw_segmentation_row(context);
  else
    draw_wrapped(
        colour::quiet_text,
        fmt::format("The engine \"{}\" takes the map as it is. How it is cut into lights is for presets of the "
                    "engine \"environment\".",
                    preset.settings.engine()));
  draw_radiance_row(context);
  if (cuts_) draw_caustics_row(context);
  if (!shown_.error.empty()) draw_wrapped(colour::error, shown_.error);
  draw_map(context);
  if (shown_.map)
    for (const std::string& warning : shown_.map->warnings) draw_wrapped(colour::note, warning);
  if (!cuts_ || !shown_.cut) return;
  draw_summary();
  plot_.draw(shown_, std::max(8 * em(), 0.22f * ImGui::GetWindowHeight()));
  draw_table();
}

void EnvironmentPanel::follow(const Context& context) {
  const preset::Preset& preset = *context.preset();
  environment_ = *preset.scene.environment;
  cuts_ = is_engine_2(preset);
  MapPictureSize size = map_.wanted_size();
  if (size.layout != layout_) size = {layout_, size.width};
  const WantedMap wanted = wanted_map(preset, size);
  model_.want(wanted, context.tasks);
  shown_ = model_.shown();
  if (shown_.source != wanted.source) shown_ = {}; // another map's picture would be mistaken for this one's
  if (!cuts_) shown_.cut.reset();
  make_figures(context);
}

void EnvironmentPanel::make_figures(const Context& context) {
  FiguresOf of{shown_.cut, environment_.radiance, environment_.rotate_deg, {}};
  if (shown_.cut && context.run.snapshot() && context.run.snapshot_is_current())
    of.visible = visible_shares(*context.run.snapshot(), shown_.cut->segmentation.lights.size());
  if (of == figures_of_) return;
  figures_of_ = of;
  figures_.clear();
  by_flux_.clear();
  if (!of.cut) return;
  figures_ = ui::figures_of(of.cut->segmentation, of.radiance, of.rotate_deg, of.visible);
  by_flux_.resize(of.cut->segmentation.lights.size());
  std::iota(by_flux_.begin(), by_flux_.end(), std::size_t{0});
  std::stable_sort(by_flux_.begin(), by_flux_.end(),
                   [&](std::size_t a, std::size_t b) { return figures_[a].flux > figures_[b].flux; });
}

void EnvironmentPanel::draw_toolbar(const Context& context) {
  for (const auto& [layout, name, help] :
       {std::tuple{MapLayout::latitude_longitude, "latitude, longitude", "As the map's file, turned"},
        std::tuple{MapLayout::cube, "cube", "The six faces that are cut, as they are in the map"}}) {
    if (ImGui::RadioButton(name, layout_ == layout)) layout_ = layout;
    places_.note(name, help);
    ImGui::SameLine();
  }
  action_button("Open map...", context);
  ImGui::SameLine();
  const bool turns = environment_.type != preset::Environment::Type::constant;
  ImGui::BeginDisabled(!turns);
  ImGui::SetNextItemWidth(-1);
  draw_dragged(context, gestures_,
               {"rotation", "turn the environment", environment_.rotate_deg, -3600, 3600, 0.5, "turned %.1f deg",
                "About the vertical, counterclockwise as seen from above. Drag the picture sideways, or this; Ctrl and "
                "a click to type."},
               [](preset::Preset& p, double degrees) { p.scene.environment->rotate_deg = degrees; });
  ImGui::EndDisabled();
}

void EnvironmentPanel::draw_segmentation_row(const Context& context) {
  const environment::Settings& settings = environment::settings(*context.preset());
  draw_label("Lights");
  ImGui::SetNextItemWidth(-13 * em());
  int lights = settings.lights;
  constexpr int fewest_lights = environment::face_count, most_lights = 4096; // as describe_settings.h has it
  const bool changed = ImGui::SliderScalar("##lights", ImGuiDataType_S32, &lights, &fewest_lights, &most_lights, "%d",
                                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  follow_item(context, gestures_, "lights", changed, "number of lights",
              [&](preset::Preset& p) { environment::settings(p).lights = lights; });
  tooltip("How many directional lights the map is cut into. Ctrl and a click to type.");
  ImGui::SameLine();
  draw_label("by");
  ImGui::SetNextItemWidth(-1);
  Combo list("##method", std::string(preset::word(settings.segmentation)), &places_, "method");
  for (const auto& choice : preset::choices<environment::SegmentMethod>)
    if (list.entry(std::string(choice.name), choice.value == settings.segmentation, std::string(choice.sentence)))
      context.edit("method of segmentation",
                   [&](preset::Preset& p) { environment::settings(p).segmentation = choice.value; });
}

void EnvironmentPanel::draw_radiance_row(const Context& context) {
  draw_label("Radiance");
  ImGui::SetNextItemWidth(cuts_ ? -13 * em() : -1);
  draw_dragged(context, gestures_,
               {"radiance", "radiance of the environment", environment_.radiance, 0, 1e9,
                std::max(1e-3, 0.005 * environment_.radiance), "%.4g W/(m^2 sr)",
                "Luminance of the map's colour (1, 1, 1): drag it, or type with Ctrl and a click.",
                ImGuiSliderFlags_NoRoundToFormat},
               [](preset::Preset& p, double radiance) { p.scene.environment->radiance = radiance; });
  if (!cuts_) return;
  ImGui::SameLine();
  draw_label("drop below");
  ImGui::SetNextItemWidth(-1);
  double threshold = environment::settings(*context.preset()).threshold;
  ImGui::InputDouble("##threshold", &threshold, 0, 0, "%.3g");
  places_.note("threshold", "A region with no more than this part of the map's light, 0 to 1, is no light of its own.");
  if (ImGui::IsItemDeactivatedAfterEdit() && std::isfinite(threshold))
    context.edit("threshold of lights",
                 [&](preset::Preset& p) { environment::settings(p).threshold = std::clamp(threshold, 0.0, 1.0); });
}

void EnvironmentPanel::draw_caustics_row(const Context& context) {
  const environment::Settings& settings = environment::settings(*context.preset());
  draw_label("Caustics");
  bool cast = settings.cast;
  if (places_.checkbox("on surfaces", &cast, "on surfaces", "Whether caustics fall on surfaces: environment.cast."))
    context.edit("caustics on surfaces", [&](preset::Preset& p) { environment::settings(p).cast = cast; });
  ImGui::SameLine();
  bool in_air = settings.extinction > 0;
  if (places_.checkbox("in the air", &in_air, "in the air",
                       "Whether a thin medium shows them as beams: environment.extinction."))
    context.edit("caustics in the air", [&](preset::Preset& p) {
      // Such that about a fifth of the light is lost on the way from what is looked at.
      const preset::Vec3 &at = p.scene.camera.position, &to = p.scene.camera.target;
      environment::settings(p).extinction = in_air ? 0.2 / std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]) : 0;
    });
  ImGui::SameLine();
  ImGui::BeginDisabled(settings.extinction <= 0);
  ImGui::SetNextItemWidth(-1);
  draw_dragged(context, gestures_,
               {"extinction", "extinction", settings.extinction, 1e-9, 1000, 0.01 * settings.extinction,
                "extinction %.3g", "How thick that medium is: environment.extinction.",
                ImGuiSliderFlags_NoRoundToFormat},
               [](preset::Preset& p, double extinction) { environment::settings(p).extinction = extinction; });
  ImGui::EndDisabled();
}

MapContents EnvironmentPanel::contents() const { return {shown_, figures_, layout_, environment_.rotate_deg, row_}; }

std::array<double, 2> EnvironmentPanel::place_on_map(const glm::dvec3& direction) const {
  return map_.to_screen(contents(), direction);
}

void EnvironmentPanel::draw_map(const Context& context) {
  const MapDrag drag = map_.draw(contents(), std::max(10 * em(), 0.42f * ImGui::GetWindowHeight()));
  if (!shown_.map && shown_.error.empty()) {
    const auto& [x, y, width, height] = map_.area();
    draw_hint(colour::quiet_on_dark, vec({x, y}), vec({width, height}), "Reading the map");
  }
  if (const auto region = map_.hovered(); region && *region < figures_.size())
    ImGui::SetTooltip("%s", text_of(figures_[*region], *region, by_flux_.size()).c_str());
  if (environment_.type == preset::Environment::Type::constant) return; // it looks the same however it is turned
  if (drag.taken) {
    gestures_.begin();
    taken_deg_ = environment_.rotate_deg;
  }
  if (drag.moved)
    context.edit(
        "turn the environment",
        [&](preset::Preset& p) {
          p.scene.environment->rotate_deg = dragged_rotation(taken_deg_, drag.across, layout_);
        },
        gestures_.number(), true);
  if (drag.ended) context.push(command::EndGesture{});
}

void EnvironmentPanel::draw_summary() const {
  const environment::Segmentation& cut = shown_.cut->segmentation;
  std::string text = fmt::format("{}, {:.4g} W/m^2 in all", counted(cut.lights.size(), "light"),
                                 environment_.radiance * environment::luminance(cut.total_flux));
  if (!cut.dropped.empty())
    text += fmt::format("; {} too dark", counted(cut.dropped.size(), "region is", "regions are"));
  if (shown_.cut_error) text += fmt::format("; irradiance is wrong by {:.3g} %", 100 * *shown_.cut_error);
  draw_wrapped(colour::quiet_text, text);
}

void EnvironmentPanel::draw_table() {
  row_.reset();
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
  const float height = std::max(8 * em(), ImGui::GetContentRegionAvail().y);
  if (!ImGui::BeginTable("lights", 7, flags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* name : {"Light", "", "Azimuth", "Elevation", "W/m^2", "Share", "Hidden"})
    ImGui::TableSetupColumn(name);
  ImGui::TableHeadersRow();
  draw_rows_in_sight(by_flux_.size(), [&](std::size_t i) {
    const std::size_t light = by_flux_.at(i);
    const RegionFigures& f = figures_.at(light);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool marked = map_.hovered() == light;
    ImGui::Selectable(fmt::format("{}", light + 1).c_str(), marked, ImGuiSelectableFlags_SpanAllColumns);
    if (ImGui::IsItemHovered()) row_ = light;
    places_.note(fmt::format("row {}", light + 1));
    ImGui::TableNextColumn();
    ImGui::Dummy({ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()});
    ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                              IM_COL32(f.colour[0], f.colour[1], f.colour[2], 255));
    cell(fmt::format("{:.1f}", f.azimuth_deg));
    cell(fmt::format("{:.1f}", f.elevation_deg));
    cell(fmt::format("{:.3g}", f.flux));
    cell(percent(f.share));
    cell(f.occluded ? percent(*f.occluded) : std::string("-"));
  });
  ImGui::EndTable();
}

std::vector<PanelEntry> environment_panels() {
  return {{.name = "environment",
           .title = EnvironmentPanel::title,
           .make = make_panel<EnvironmentPanel>,
           .serves = EnvironmentPanel::serves,
           .front_for = "environment"}};
}

} // namespace nephroid::ui
