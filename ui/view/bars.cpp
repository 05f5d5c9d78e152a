// SPDX-License-Identifier: Apache-2.0
#include "ui/view/bars.h"

#include "preset/choices.h"
#include "run/display.h"
#include "ui/widgets/action.h"
#include "ui/widgets/colour_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

void draw_layer_choice(const Context& context, WidgetPlaces& places) {
  const std::string& chosen = context.comparing.comparison().layer;
  ImGui::SetNextItemWidth(8 * em());
  Combo list("##layer", chosen.empty() ? "all" : chosen, &places, "layer");
  if (list.entry("all", chosen.empty())) context.push(command::ShowLayer{});
  if (const auto source = context.comparing.source())
    for (const job::Layer& layer : source->layers)
      if (list.entry(layer.name, chosen == layer.name)) context.push(command::ShowLayer{layer.name});
}

/// Draws a list of the words of one of the fields of the preset's `display`; false_colour: with that as one more.
template <class E>
void draw_display_choice(const Context& context, const char* name, E preset::Display::*field, WidgetPlaces& places,
                         bool false_colour = false) {
  const bool in_preset = run::has_display(*context.preset()),
             is_false = false_colour && context.view_settings().false_colour;
  const E now = context.preset()->display.*field;
  const auto show_false = [&](bool on) {
    ViewSettings view_settings = context.view_settings();
    if (!false_colour || view_settings.false_colour == on) return;
    view_settings.false_colour = on;
    context.push(command::SetViewSettings{view_settings});
  };
  ImGui::SetNextItemWidth((false_colour ? 7 : 5) * em());
  const std::string plain = "as image.png";
  Combo list(fmt::format("##{}", name).c_str(),
             is_false    ? "false colour"
             : in_preset ? std::string(preset::word(now))
                         : plain,
             &places, name);
  if (!in_preset) {
    if (list.entry(plain, !is_false, "sRGB, clipped at 1")) show_false(false);
  } else
    for (const auto& choice : preset::choices<E>)
      if (list.entry(std::string(choice.name), !is_false && choice.value == now, std::string(choice.sentence))) {
        show_false(false);
        if (choice.value != now)
          context.edit(fmt::format("{} {}", name, choice.name),
                       [&](preset::Preset& p) { p.display.*field = choice.value; });
      }
  if (false_colour &&
      list.entry("false colour", is_false,
                 "The luminance as a colour, on a logarithmic scale in W/m2/sr. Exposure plays no part."))
    show_false(true);
}

/// Draws a number field in the line of the last item. True where a person typed a value.
bool draw_number(const char* label, double& value) {
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5 * em());
  ImGui::InputDouble(label, &value, 0, 0, "%.3g");
  return ImGui::IsItemDeactivatedAfterEdit();
}

void draw_range_choice(const Context& context, const LuminanceRange& shown, WidgetPlaces& places) {
  const auto set = [&](const std::optional<LuminanceRange>& range) {
    ViewSettings view_settings = context.view_settings();
    view_settings.range = range;
    context.push(command::SetViewSettings{view_settings});
  };
  bool automatic = !context.view_state.view_settings.range;
  if (places.checkbox("Auto range", &automatic, "auto range",
                      "From where 1 % of the pixels are below to where 99.9 % are; else as typed here."))
    set(automatic ? std::nullopt : std::optional(shown));
  LuminanceRange typed = shown;
  ImGui::BeginDisabled(automatic);
  const bool low = draw_number("##low", typed.low);
  places.note("low", "W/m2/sr at the foot of the colours");
  const bool high = draw_number("##high", typed.high);
  places.note("high", "W/m2/sr at their end");
  ImGui::EndDisabled();
  if (!low && !high) return;
  if (typed.low > 0 && typed.high > typed.low && std::isfinite(typed.high))
    set(typed);
  else
    context.note("false colour: the range needs 0 < low < high");
}

using Metric = measure::DifferenceMetric;
constexpr std::array<std::pair<Metric, const char*>, 6> metric_names{{{Metric::lab, "CIELAB distance"},
                                                                      {Metric::absolute, "|a - b|"},
                                                                      {Metric::relative, "relative |a - b|"},
                                                                      {Metric::square, "(a - b)^2"},
                                                                      {Metric::luminance, "luminance a - b"},
                                                                      {Metric::flip, "FLIP"}}};

/// Draws a list of these choices, names and ids, and of all pins.
template <class Chosen>
void draw_picture_choice(const Context& context, WidgetPlaces& places, const char* place, const std::string& name,
                         std::uint64_t now, std::vector<std::pair<std::string, std::uint64_t>> choices) {
  for (const PinnedRun& run : context.comparing.pinned().all()) choices.emplace_back(run.name, run.id);
  ImGui::SetNextItemWidth(8 * em());
  Combo list(fmt::format("##{}", place).c_str(), name, &places, place);
  for (const auto& [choice, id] : choices)
    if (list.entry(choice, now == id)) context.push(Chosen{id});
}

void draw_metric_choice(const Context& context) {
  const Comparison& comparison = context.comparing.comparison();
  ImGui::SetNextItemWidth(10 * em());
  Combo list("##difference metric", metric_name(comparison.metric));
  for (const auto& [metric, name] : metric_names)
    if (list.entry(name, metric == comparison.metric))
      context.push(command::ShowDifference{true, metric, 0}); // values of another metric have another magnitude
}

void draw_range_of_difference(const Context& context) {
  const Comparison& comparison = context.comparing.comparison();
  const auto set = [&](double scale) { context.push(command::ShowDifference{true, comparison.metric, scale}); };
  const auto& map = context.comparing.difference();
  bool automatic = comparison.scale == 0;
  double scale = automatic && map ? map->scale : comparison.scale;
  if (ImGui::Checkbox("Auto", &automatic)) set(automatic ? 0 : map ? map->scale : 1);
  tooltip("The colours end where 99 % of the pixels are below; else at the value given here.");
  ImGui::BeginDisabled(comparison.scale == 0);
  if (draw_number("##scale", scale) && scale > 0) set(scale);
  ImGui::EndDisabled();
}

void draw_selected_choice(const Context& context, WidgetPlaces& places) {
  const preset::Preset& preset = *context.preset();
  const Selection now = context.selection();
  ImGui::SetNextItemWidth(
      std::clamp(ImGui::GetContentRegionAvail().x - 26 * em(), 5 * em(), 12 * em())); // leaves the rest to the buttons
  Combo list("##selected", now == Selection{} ? "nothing" : name_of(preset, now), &places, "selected");
  if (list.entry("nothing", now == Selection{})) context.push(command::Select{});
  for (const Selection& selection : selectable(preset))
    if (list.entry(name_of(preset, selection), selection == now)) context.push(command::Select{selection});
}

/// A button that stays down while its action is on.
void draw_toggle(const char* name, const Context& context) {
  const bool on = action(name).checked(context);
  ImGui::SameLine();
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button(name, context);
  if (on) ImGui::PopStyleColor();
}

void draw_bookmarks(const Context& context, WidgetPlaces& places) {
  std::vector<Bookmark> bookmarks = context.view_state.bookmarks;
  std::optional<std::size_t> deleted;
  bool changed = false;
  for (std::size_t i = 0; i < bookmarks.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (places.button("Go", fmt::format("go {}", i), i < 9 ? fmt::format("Ctrl+{}", i + 1) : std::string())) {
      go_to_bookmark(context, i);
      ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    std::string name = bookmarks[i].name;
    ImGui::SetNextItemWidth(14 * em());
    if (ImGui::InputTextWithHint("##name", "", &name) && !name.empty()) {
      bookmarks[i].name = std::move(name);
      changed = true;
    }
    places.note(fmt::format("name {}", i));
    ImGui::SameLine();
    if (places.button("x", fmt::format("delete {}", i), "Delete this bookmark")) deleted = i;
    ImGui::PopID();
  }
  if (deleted) bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(*deleted));
  if (changed || deleted) context.push(command::SetBookmarks{bookmarks});
  if (bookmarks.empty()) ImGui::TextDisabled("No camera is bookmarked yet.");
  action_button("Bookmark this camera", context);
  places.note("bookmark");
}

} // namespace

void go_to_bookmark(const Context& context, std::size_t index) {
  const auto& [name, bookmarked] = context.view_state.bookmarks.at(index);
  const preset::Camera& now = context.preset()->scene.camera;
  preset::Camera camera = bookmarked;
  camera.resolution = now.resolution; // a bookmark does not change the picture's size
  if (camera != now) context.edit("go to " + name, [&](preset::Preset& p) { p.scene.camera = camera; });
}

void draw_view_bar(const Context& context, const Tone& tone, WidgetPlaces& places) {
  draw_label("Layer");
  draw_layer_choice(context, places);
  ImGui::SameLine(0, em());
  draw_label("Tone");
  draw_display_choice(context, "tone", &preset::Display::tone, places, true);
  if (tone.false_colour) {
    same_line_if_room(ImGui::CalcTextSize("Auto range").x + 14 * em());
    return draw_range_choice(context, *tone.false_colour, places);
  }
  if (!run::has_display(*context.preset())) return;
  same_line_if_room(ImGui::CalcTextSize("Gamut").x + 5.5f * em());
  draw_label("Gamut");
  draw_display_choice(context, "gamut", &preset::Display::gamut, places);
  same_line_if_room(ImGui::CalcTextSize("White").x + 5.5f * em());
  draw_label("White");
  draw_display_choice(context, "white balance", &preset::Display::white_balance, places);
}

std::string metrics_as_text(const Context& context) {
  const Comparing& comparing = context.comparing;
  const auto quick = comparing.metrics(), full = comparing.all_metrics();
  if (!quick || !quick->error.empty()) return quick ? quick->error : std::string();
  const auto described = [&](const std::string& name, std::uint64_t pin) {
    const PinnedRun* pinned = comparing.pinned().find(pin);
    return pinned && !pinned->read_as.empty() ? fmt::format("{} ({})", name, pinned->read_as) : name;
  };
  std::string text =
      fmt::format("{} to {}; linear sRGB, 1 is white\n", described(comparing.name(), comparing.comparison().shown),
                  described(comparing.other_name(), comparing.comparison().pin));
  for (const measure::Metric& metric : measure::all_metrics()) {
    const bool is_quick = metric.kind != measure::Metric::Kind::perceptual;
    const double value = is_quick                      ? metric.of(quick->metrics)
                         : full && full->error.empty() ? metric.of(full->metrics)
                                                       : NAN;
    text += fmt::format("{}\t{}\t{}\n", metric.name, std::isfinite(value) ? fmt::format("{:.6g}", value) : "-",
                        metric.meaning);
  }
  return text;
}

const char* metric_name(Metric metric) {
  return std::ranges::find(metric_names, metric, &std::pair<Metric, const char*>::first)->second;
}

void draw_comparison_bar(const Context& context, WidgetPlaces& places) {
  const Comparison& comparison = context.comparing.comparison();
  draw_label("Compare");
  if (!context.comparing.pinned().all().empty()) {
    draw_picture_choice<command::ShowPicture>(context, places, "shown", context.comparing.name(), comparison.shown,
                                              {{"this run", 0}});
    ImGui::SameLine();
    draw_label("with");
  }
  draw_picture_choice<command::CompareWith>(context, places, "other", context.comparing.other_name(), comparison.pin,
                                            {{"Reference", 0}, {"this run", Comparison::run_in_hand}});
  ImGui::SameLine();
  action_button("Flip", context);
  for (const char* name : {"Difference", "Split", "Side by side"}) draw_toggle(name, context);
  if (!comparison.difference) return;
  ImGui::SameLine();
  draw_metric_choice(context);
  ImGui::SameLine();
  draw_range_of_difference(context);
}

void draw_metrics(const Context& context, WidgetPlaces& places) {
  const Comparing& comparing = context.comparing;
  if (!comparing.comparison().measures()) return;
  const auto quick = comparing.metrics(), full = comparing.all_metrics();
  std::string line;
  if (const std::string why = comparing.why_not(); !why.empty())
    line = "Not measured: " + why;
  else if (!quick)
    line = "Being measured";
  else if (!quick->error.empty())
    line = "Not measured: " + quick->error;
  else
    line = fmt::format("rel_l2 {:.3g}   CIELAB {:.3g}   FLIP {}   of {} to {}", quick->metrics.rel_l2,
                       quick->metrics.lab_mean,
                       full && full->metrics.flip ? fmt::format("{:.3g}", *full->metrics.flip) : "...",
                       comparing.name(), comparing.other_name());
  draw_text(colour::quiet_text, line);
  places.note("metrics");
  if (quick && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", metrics_as_text(context).c_str());
}

void draw_selection_bar(const Context& context, WidgetPlaces& places) {
  if (!has_scene(*context.preset())) return;
  draw_label("Selected");
  draw_selected_choice(context, places);
  for (const char* tool : {"Move", "Turn", "Scale", "Own axes", "Snap"}) {
    draw_toggle(tool, context);
    places.note(tool);
  }
  ImGui::SameLine();
  if (places.button("Cameras", "cameras", "Bookmarks of cameras")) ImGui::OpenPopup("cameras");
  if (!ImGui::BeginPopup("cameras")) return;
  draw_bookmarks(context, places);
  ImGui::EndPopup();
}

void draw_overlay(const ImVec2& at, const std::string& text) {
  const float pad = 0.4f * em();
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddRectFilled(at, at + extent + ImVec2(2 * pad, 2 * pad), colour::overlay, pad);
  draw_list->AddText(at + ImVec2(pad, pad), colour::on_dark, text.c_str());
}

void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas) {
  const double low = std::log10(range.low), high = std::log10(range.high);
  std::vector<ScaleMark> marks{{0, fmt::format("{:.3g}", range.low)}, {1, fmt::format("{:.3g}", range.high)}};
  for (int decade = static_cast<int>(std::ceil(low)); decade <= high; ++decade) // none that would touch the ends
    if (const double position = (decade - low) / (high - low); position > 0.06 && position < 0.94)
      marks.emplace_back(position, fmt::format("{:.3g}", std::pow(10.0, decade)));
  if (marks.size() > 12) marks.resize(2);
  const std::array keys{ScaleKey{negative_colour, "negative"}, ScaleKey{infinite_colour, "infinite"},
                        ScaleKey{nan_colour, "NaN"}};
  draw_scale(
      vec(canvas.corner), vec(canvas.size), "W/m2/sr", marks,
      [](float position) { return measure::map_colour(static_cast<double>(position)); }, keys);
}

void draw_difference_scale(const ShownDifference& map, const Canvas& canvas) {
  draw_linear_scale(vec(canvas.corner), vec(canvas.size), "", map.scale, measure::is_signed(map.of.metric));
}

} // namespace nephroid::ui
