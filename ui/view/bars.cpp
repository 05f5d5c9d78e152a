// SPDX-License-Identifier: Apache-2.0
#include "ui/view/bars.h"

#include "ui/widgets/action.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

struct NamedTone {
  const char *name, *help;
};
/// In the order of ToneCurve.
constexpr std::array tones{
    NamedTone{"as image.png", "sRGB, clipped at 1: the bytes of image.png"},
    NamedTone{"filmic", "For a wide range: a soft shoulder up to 5.6 times white (Hable 2010), then sRGB"},
    NamedTone{"false colour", "The luminance as a colour, on a logarithmic scale in W/m2/sr. Exposure plays no part."},
};

void draw_layer_choice(const Context& context, WidgetPlaces& places)
{
  const std::string& chosen = context.comparing.comparison().layer;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (!ImGui::BeginCombo("##layer", chosen.empty() ? "all" : chosen.c_str())) return places.note("layer");
  if (ImGui::Selectable("all", chosen.empty())) context.push(command::ShowLayer{});
  if (const auto& snapshot = context.run.snapshot())
    for (const job::Layer& layer : snapshot->picture->layers) {
      if (ImGui::Selectable(layer.name.c_str(), chosen == layer.name)) context.push(command::ShowLayer{layer.name});
      places.note("layer " + layer.name);
    }
  ImGui::EndCombo();
}

void draw_tone_choice(const Context& context, WidgetPlaces& places)
{
  Look look = context.look();
  const auto now = static_cast<std::size_t>(look.tone);
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (!ImGui::BeginCombo("##tone", tones.at(now).name)) return places.note("tone");
  for (std::size_t i = 0; i < tones.size(); ++i) {
    if (ImGui::Selectable(tones[i].name, i == now)) {
      look.tone = static_cast<ToneCurve>(i);
      context.push(command::SetLook{look});
    }
    places.note("tone " + std::string(tones[i].name));
    ImGui::SetItemTooltip("%s", tones[i].help);
  }
  ImGui::EndCombo();
}

void draw_range_choice(const Context& context, const LuminanceRange& shown, WidgetPlaces& places)
{
  const auto set = [&](const std::optional<LuminanceRange>& range) {
    Look look = context.look();
    look.false_colour = range;
    context.push(command::SetLook{look});
  };
  bool automatic = !context.chosen.look.false_colour;
  if (ImGui::Checkbox("Auto range", &automatic)) set(automatic ? std::nullopt : std::optional(shown));
  places.note("auto range");
  ImGui::SetItemTooltip("From where 1 %% of the pixels are below to where 99.9 %% are; else as typed here.");
  LuminanceRange typed = shown;
  ImGui::BeginDisabled(automatic);
  const auto number = [&](const char* label, double& value, const char* help) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    ImGui::InputDouble(label, &value, 0, 0, "%.3g");
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    places.note(label + 2);
    ImGui::SetItemTooltip("%s", help);
    return done;
  };
  const bool low = number("##low", typed.low, "W/m2/sr at the foot of the colours");
  const bool high = number("##high", typed.high, "W/m2/sr at their end");
  ImGui::EndDisabled();
  if (!low && !high) return;
  if (typed.low > 0 && typed.high > typed.low && std::isfinite(typed.high))
    set(typed);
  else
    context.note("false colour: the range needs 0 < low < high");
}

/// In the order of measure::DifferenceMetric.
constexpr std::array metric_names{"CIELAB distance", "|a - b|", "relative |a - b|", "(a - b)^2", "luminance a - b", "FLIP"};

void draw_other_choice(const Context& context)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
  if (!ImGui::BeginCombo("##other", other_name(context).c_str())) return;
  const auto choice = [&](const char* name, std::uint64_t pin) {
    if (ImGui::Selectable(name, context.comparing.comparison().pin == pin)) context.push(command::CompareWith{pin});
  };
  choice("Reference", 0);
  for (const PinnedRun& run : context.comparing.pinned().all()) {
    ImGui::PushID(static_cast<int>(run.id));
    choice(run.name.c_str(), run.id);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void draw_metric_choice(const Context& context)
{
  const Comparison& comparison = context.comparing.comparison();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
  if (!ImGui::BeginCombo("##difference metric", metric_name(comparison.metric))) return;
  for (std::size_t i = 0; i < metric_names.size(); ++i)
    if (const auto metric = static_cast<measure::DifferenceMetric>(i); ImGui::Selectable(metric_names[i], metric == comparison.metric))
      context.push(command::ShowDifference{true, metric, 0}); // the values of another metric have another size
  ImGui::EndCombo();
}

void draw_range_of_difference(const Context& context)
{
  const Comparison& comparison = context.comparing.comparison();
  const auto set = [&](double scale) { context.push(command::ShowDifference{true, comparison.metric, scale}); };
  const auto& map = context.comparing.difference();
  bool automatic = comparison.scale == 0;
  if (ImGui::Checkbox("Auto", &automatic)) set(automatic ? 0 : map ? map->scale : 1);
  ImGui::SetItemTooltip("The colours end where 99 %% of the pixels are below; else at the value given here.");
  ImGui::SameLine();
  double scale = comparison.scale == 0 && map ? map->scale : comparison.scale;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
  ImGui::BeginDisabled(comparison.scale == 0);
  ImGui::InputDouble("##scale", &scale, 0, 0, "%.3g");
  if (ImGui::IsItemDeactivatedAfterEdit() && scale > 0) set(scale);
  ImGui::EndDisabled();
}

void draw_selected_choice(const Context& context, WidgetPlaces& places)
{
  const preset::Preset& preset = *context.preset();
  const Selection now = context.selection();
  const std::string name = now == Selection{} ? "nothing" : name_of(preset, now);
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(std::clamp(ImGui::GetContentRegionAvail().x - 26 * em, 5 * em, 12 * em)); // the buttons have the rest
  const bool open = ImGui::BeginCombo("##selected", name.c_str());
  places.note("selected");
  if (!open) return;
  const auto choice = [&](const std::string& label, const Selection& selection) {
    if (ImGui::Selectable(fmt::format("{}##{}", label, pointer_of(selection)).c_str(), selection == now))
      context.push(command::Select{selection});
    places.note("select " + label);
  };
  choice("nothing", {});
  for (const Selection& selection : selectable(preset)) choice(name_of(preset, selection), selection);
  ImGui::EndCombo();
}

/// A button that stays down while what it does is on.
void draw_toggle(const char* name, const Context& context, WidgetPlaces& places)
{
  const bool on = action(name).checked(context);
  ImGui::SameLine();
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button(name, context);
  if (on) ImGui::PopStyleColor();
  places.note(name);
}

void draw_bookmarks(const Context& context, WidgetPlaces& places)
{
  const std::vector<Bookmark>& bookmarks = context.chosen.bookmarks;
  for (std::size_t i = 0; i < bookmarks.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Button("Go")) {
      context.push(command::GoToBookmark{i});
      ImGui::CloseCurrentPopup();
    }
    if (i < 9) ImGui::SetItemTooltip("Ctrl+%d", static_cast<int>(i) + 1);
    places.note(fmt::format("go {}", i));
    ImGui::SameLine();
    std::string name = bookmarks[i].name;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
    if (input_text("##name", "", name)) context.push(command::RenameBookmark{i, name});
    places.note(fmt::format("name {}", i));
    ImGui::SameLine();
    if (ImGui::Button("x")) context.push(command::DeleteBookmark{i});
    ImGui::SetItemTooltip("Delete this bookmark");
    places.note(fmt::format("delete {}", i));
    ImGui::PopID();
  }
  if (bookmarks.empty()) ImGui::TextDisabled("No camera is bookmarked yet.");
  action_button("Bookmark this camera", context);
  places.note("bookmark");
}

} // namespace

void draw_look_bar(const Context& context, const Tone& tone, WidgetPlaces& places)
{
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Layer");
  ImGui::SameLine();
  draw_layer_choice(context, places);
  ImGui::SameLine(0, ImGui::GetFontSize());
  ImGui::TextUnformatted("Tone");
  ImGui::SameLine();
  draw_tone_choice(context, places);
  if (tone.curve != ToneCurve::false_colour) return;
  const float width = ImGui::CalcTextSize("Auto range").x + 14 * ImGui::GetFontSize();
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
  draw_range_choice(context, tone.range, places);
}

const char* metric_name(measure::DifferenceMetric metric) { return metric_names.at(static_cast<std::size_t>(metric)); }

std::string other_name(const Context& context)
{
  const PinnedRun* pin = context.comparing.pinned().find(context.comparing.comparison().pin);
  return pin ? '"' + pin->name + '"' : "Reference";
}

void draw_comparison_bar(const Context& context)
{
  const Comparison& comparison = context.comparing.comparison();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Compare");
  ImGui::SameLine();
  draw_other_choice(context);
  ImGui::SameLine();
  action_button("Flip", context);
  ImGui::SameLine();
  if (comparison.difference) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button("Difference", context);
  if (!comparison.difference) return;
  ImGui::PopStyleColor();
  ImGui::SameLine();
  draw_metric_choice(context);
  ImGui::SameLine();
  draw_range_of_difference(context);
}

void draw_selection_bar(const Context& context, WidgetPlaces& places)
{
  if (!context.preset() || !has_scene(*context.preset())) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Selected");
  ImGui::SameLine();
  draw_selected_choice(context, places);
  for (const char* tool : {"Move", "Turn", "Scale", "Own axes", "Snap"}) draw_toggle(tool, context, places);
  ImGui::SameLine();
  if (ImGui::Button("Cameras")) ImGui::OpenPopup("cameras");
  ImGui::SetItemTooltip("Bookmarks of cameras");
  places.note("cameras");
  if (!ImGui::BeginPopup("cameras")) return;
  draw_bookmarks(context, places);
  ImGui::EndPopup();
}

} // namespace nephroid::ui
