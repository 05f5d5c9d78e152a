// SPDX-License-Identifier: Apache-2.0
#include "ui/view/comparison_bar.h"

#include "ui/view/colour_scale.h"
#include "ui/widgets/action.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

namespace nephroid::ui {
namespace {

using measure::DifferenceMetric;

struct NamedMetric {
  DifferenceMetric metric;
  const char* name;
};
constexpr NamedMetric all_metrics[] = {{DifferenceMetric::lab, "CIELAB distance"},       {DifferenceMetric::absolute, "|a - b|"},
                                       {DifferenceMetric::relative, "relative |a - b|"}, {DifferenceMetric::square, "(a - b)^2"},
                                       {DifferenceMetric::luminance, "luminance a - b"}, {DifferenceMetric::flip, "FLIP"}};

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
  for (const auto& [metric, name] : all_metrics)
    if (ImGui::Selectable(name, metric == comparison.metric))
      context.push(command::ShowDifference{true, metric, 0}); // the values of another metric have another size
  ImGui::EndCombo();
}

void draw_scale_choice(const Context& context)
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

} // namespace

const char* metric_name(DifferenceMetric metric)
{
  return std::find_if(std::begin(all_metrics), std::end(all_metrics), [&](const NamedMetric& named) { return named.metric == metric; })
      ->name;
}

std::string other_name(const Context& context)
{
  const PinnedRun* pin = context.comparing.pinned().find(context.comparing.comparison().pin);
  return pin ? '"' + pin->name + '"' : "Reference";
}

std::string difference_label(const Context& context)
{
  const std::string other = context.comparing.comparison().pin == 0 ? "the reference" : other_name(context);
  return fmt::format("{} to {}", metric_name(context.comparing.comparison().metric), other);
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
  draw_scale_choice(context);
}

void draw_colour_scale(const ShownDifference& map, const Canvas& canvas)
{
  const bool is_signed = measure::is_signed(map.of.metric);
  constexpr int numbers = 5;
  std::vector<ScaleMark> marks;
  for (int i = 0; i < numbers; ++i) {
    const double position = static_cast<double>(i) / (numbers - 1);
    marks.emplace_back(position, fmt::format("{:.3g}", map.scale * (is_signed ? 2 * position - 1 : position)));
  }
  draw_scale(canvas, "", marks, [&](float position) { return measure::map_colour(static_cast<double>(position), is_signed); });
}

} // namespace nephroid::ui
