// SPDX-License-Identifier: Apache-2.0
#include "ui/error/panel.h"

#include "measure/run_curves.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

constexpr const char* this_run = "this run";
constexpr const char* nothing_measured = "nothing measured"; ///< in the box of metrics, as wide as any name of one

/// Every metric of the run in hand and of the pinned ones, each once.
std::vector<std::string> all_metrics(const Context& context) {
  std::vector<std::string> all;
  const auto add = [&](const job::History& history) {
    for (std::string& metric : measure::metric_names(history))
      if (std::ranges::count(all, metric) == 0) all.push_back(std::move(metric));
  };
  if (const auto history = context.run.error_history()) add(*history);
  for (const PinnedRun& pin : context.comparing.pinned().runs()) add(*pin.history);
  return all;
}

std::string empty_hint(const Context& context) {
  if (!context.run.snapshot()) return "Nothing is measured yet";
  if (!context.run.error_history())
    return "This run is not measured: the preset has no reference, and measure.estimate is false";
  if (context.run.status().state == job::State::finished)
    return "The run ended without a measurement: its notes say why";
  return "The first measurement is to come";
}

/// The target where it is about this metric.
std::optional<double> target_of(const Context& context, const std::string& metric) {
  const auto history = context.run.error_history();
  if (!history || measure::error_column_of(history->error_column).metric != metric) return std::nullopt;
  return history->target;
}

} // namespace

std::string shown_metric(const Context& context) {
  const std::vector<std::string> all = all_metrics(context);
  const auto there = [&](const std::string& metric) { return std::ranges::count(all, metric) > 0; };
  if (there(context.view_state.error_metric)) return context.view_state.error_metric;
  if (const auto history = context.run.error_history();
      history && there(measure::error_column_of(history->error_column).metric))
    return measure::error_column_of(history->error_column).metric;
  return all.empty() ? std::string() : all.front();
}

std::string plot_as_csv(const Context& context) {
  const std::string metric = shown_metric(context);
  std::vector<NamedLines> runs;
  for (const PinnedRun& pin : context.comparing.pinned().runs())
    if (pin.shown) runs.push_back({pin.name, lines_of(*pin.history, metric)});
  if (const auto history = context.run.error_history()) runs.push_back({this_run, lines_of(*history, metric)});
  return plot_csv(runs, target_of(context, metric));
}

const RunLines& ErrorPanel::lines(std::uint64_t id, const std::shared_ptr<const job::History>& history) {
  Known& known = known_[id];
  if (known.history != history || known.metric != contents_.metric)
    known = {history, contents_.metric, history ? lines_of(*history, contents_.metric) : RunLines{}};
  return known.lines;
}

void ErrorPanel::collect(const Context& context) {
  contents_.metric = shown_metric(context);
  contents_.target = target_of(context, contents_.metric);
  contents_.runs.clear();
  std::erase_if(known_,
                [&](const auto& entry) { return entry.first != 0 && !context.comparing.pinned().find(entry.first); });
  for (const PinnedRun& pin : context.comparing.pinned().runs())
    if (const RunLines& pin_lines = lines(pin.id, pin.history); pin.shown && !pin_lines.empty())
      contents_.runs.push_back({pin.name, pin.colour, 1.5f, &pin_lines});
  if (const RunLines& present = lines(0, context.run.error_history()); !present.empty())
    contents_.runs.push_back({this_run, colour::on_dark, 2, &present});
}

void ErrorPanel::draw(const Context& context) {
  collect(context);
  draw_toolbar(context);
  const float height = ImGui::GetContentRegionAvail().y;
  const std::vector<PinnedRun> runs = context.comparing.pinned().runs();
  const float pins = std::min(0.45f * height, 4.2f * em() * static_cast<float>(runs.size()));
  plot_.draw(contents_, std::max(height - pins - ImGui::GetStyle().ItemSpacing.y, 8 * em()));
  if (contents_.runs.empty()) {
    const auto& [x, y, width, plot_height] = plot_.area();
    draw_hint(colour::quiet_on_dark, vec({x, y}), vec({width, plot_height}), empty_hint(context));
  }
  if (pins == 0) return;
  if (ImGui::BeginChild("pins"))
    for (const PinnedRun& pin : runs) {
      ImGui::PushID(static_cast<int>(pin.id));
      draw_pin(context, pin);
      ImGui::PopID();
    }
  ImGui::EndChild();
}

void ErrorPanel::draw_toolbar(const Context& context) {
  const char* const shown = contents_.metric.empty() ? nothing_measured : contents_.metric.c_str();
  ImGui::SetNextItemWidth(ImGui::CalcTextSize(shown).x + 2 * ImGui::GetStyle().FramePadding.x +
                          ImGui::GetFrameHeight());
  {
    Combo list("##metric", shown);
    for (const std::string& metric : all_metrics(context))
      if (list.entry(metric, metric == contents_.metric)) context.push(command::ChooseMetric{metric});
  }
  tooltip("The error that is shown; docs/comparing.md defines each. Solid: against the reference; dashed: the run's "
          "own estimate.");
  ImGui::SameLine();
  action_button("Pin this run", context);
  ImGui::SameLine();
  action_button("Open history...", context);
  ImGui::SameLine();
  if (ImGui::Button("Copy...")) ImGui::OpenPopup("copy");
  if (ImGui::BeginPopup("copy")) {
    action_item(action("Copy history as CSV"), context);
    action_item(action("Copy plot as CSV"), context);
    ImGui::EndPopup();
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(plot_.follows());
  if (ImGui::Button("All")) plot_.follow();
  ImGui::EndDisabled();
  tooltip("Axes that show everything and grow with the run; a double click on the plot does the same. Wheel zooms, "
          "drag moves.");
}

void ErrorPanel::draw_pin(const Context& context, const PinnedRun& pin) {
  const auto change = [&](const std::string& name, std::uint32_t to_colour, bool shown) {
    context.push(command::ChangePin{pin.id, name, to_colour, shown});
  };
  bool shown = pin.shown;
  if (ImGui::Checkbox("##shown", &shown)) change({}, pin.colour, shown);
  tooltip("In the plot");
  ImGui::SameLine();
  ImVec4 edited = ImGui::ColorConvertU32ToFloat4(pin.colour);
  if (ImGui::ColorEdit3("##colour", &edited.x, ImGuiColorEditFlags_NoInputs))
    change({}, ImGui::ColorConvertFloat4ToU32(edited), pin.shown);
  ImGui::SameLine();
  const float buttons = ImGui::CalcTextSize("CompareUnpin").x + 4 * ImGui::GetStyle().FramePadding.x +
                        3 * ImGui::GetStyle().ItemSpacing.x + ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - buttons, 4 * em()));
  std::string name = pin.name;
  ImGui::InputTextWithHint("##name", "name", &name);
  if (ImGui::IsItemDeactivatedAfterEdit()) change(name, pin.colour, pin.shown);
  ImGui::SameLine();
  const bool compared = context.comparing.comparison().pin == pin.id;
  if (ImGui::RadioButton("Compare", compared)) context.push(command::CompareWith{compared ? 0 : pin.id});
  tooltip(pin.picture ? "The View flips to this run's picture and shows the difference from it"
                      : "Only a history was read: the View has no picture of this run");
  ImGui::SameLine();
  if (ImGui::Button("Unpin")) context.push(command::Unpin{pin.id});
  draw_wrapped(colour::quiet_text, findings(context, pin));
}

/// The run's slope, and how much faster the run in hand is at equal error: the error and both times belong to it.
std::string ErrorPanel::findings(const Context& context, const PinnedRun& pin) {
  const RunLines &pin_lines = lines(pin.id, pin.history), &present = lines(0, context.run.error_history());
  if (pin_lines.empty())
    return fmt::format("no {} in its history", contents_.metric.empty() ? "error" : contents_.metric);
  std::string text;
  if (const auto& fit = pin_lines.judged().fit) text = fmt::format("slope {:.2f}; ", fit->exponent);
  const auto equal = speed_up(pin_lines, present);
  if (!equal) return text + "no error yet that both runs came to";
  return text + fmt::format("at {} {:.3g}{}: {:.3g} s, this run {:.3g} s, {:.3g} times as fast", contents_.metric,
                            equal->error, equal->by_estimate ? " by both estimates" : "", equal->seconds_a,
                            equal->seconds_b, equal->speed_up());
}

} // namespace nephroid::ui
