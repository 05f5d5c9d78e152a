// SPDX-License-Identifier: Apache-2.0
#include "ui/view/comparison_bar.h"

#include "ui/shell/actions.h"
#include "ui/state/workbench.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace nephroid::ui {
namespace {

using measure::DifferenceMetric;

constexpr std::array all_metrics{DifferenceMetric::lab,    DifferenceMetric::absolute,  DifferenceMetric::relative,
                                 DifferenceMetric::square, DifferenceMetric::luminance, DifferenceMetric::flip};

void draw_other_choice(const Workbench& workbench, Commands& commands)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
  if (!ImGui::BeginCombo("##other", other_name(workbench).c_str())) return;
  const auto choice = [&](const char* name, std::uint64_t pin) {
    if (ImGui::Selectable(name, workbench.comparison().pin == pin)) commands.push_back(command::CompareWith{pin});
  };
  choice("Reference", 0);
  for (const PinnedRun& run : workbench.pinned().all()) {
    ImGui::PushID(static_cast<int>(run.id));
    choice(run.name.c_str(), run.id);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void draw_metric_choice(const Comparison& comparison, Commands& commands)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
  if (!ImGui::BeginCombo("##difference metric", metric_name(comparison.metric))) return;
  for (const DifferenceMetric metric : all_metrics)
    if (ImGui::Selectable(metric_name(metric), metric == comparison.metric))
      commands.push_back(command::ShowDifference{true, metric, 0}); // the values of another metric have another size
  ImGui::EndCombo();
}

void draw_scale_choice(const Workbench& workbench, Commands& commands)
{
  const Comparison& comparison = workbench.comparison();
  const auto set = [&](double scale) { commands.push_back(command::ShowDifference{true, comparison.metric, scale}); };
  const auto& map = workbench.difference();
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
  switch (metric) {
  case DifferenceMetric::lab:
    return "CIELAB distance";
  case DifferenceMetric::absolute:
    return "|a - b|";
  case DifferenceMetric::relative:
    return "relative |a - b|";
  case DifferenceMetric::square:
    return "(a - b)^2";
  case DifferenceMetric::luminance:
    return "luminance a - b";
  case DifferenceMetric::flip:
    return "FLIP";
  }
  return "";
}

std::string other_name(const Workbench& workbench)
{
  const PinnedRun* pin = workbench.pinned().find(workbench.comparison().pin);
  return pin ? '"' + pin->name + '"' : "Reference";
}

std::string difference_label(const Workbench& workbench)
{
  const std::string other = workbench.comparison().pin == 0 ? "the reference" : other_name(workbench);
  return fmt::format("{} to {}", metric_name(workbench.comparison().metric), other);
}

void draw_comparison_bar(const Workbench& workbench, Commands& commands)
{
  const Comparison& comparison = workbench.comparison();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Compare");
  ImGui::SameLine();
  draw_other_choice(workbench, commands);
  ImGui::SameLine();
  action_button("Flip", workbench, commands);
  ImGui::SameLine();
  if (comparison.difference) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button("Difference", workbench, commands);
  if (!comparison.difference) return;
  ImGui::PopStyleColor();
  ImGui::SameLine();
  draw_metric_choice(comparison, commands);
  ImGui::SameLine();
  draw_scale_choice(workbench, commands);
}

void draw_colour_scale(const ShownDifference& map, const Canvas& canvas)
{
  const bool is_signed = measure::is_signed(map.of.metric);
  const float em = ImGui::GetFontSize();
  const float height = std::min(16 * em, 0.7f * static_cast<float>(canvas.size[1])), width = em;
  const ImVec2 corner{static_cast<float>(canvas.corner[0] + canvas.size[0]) - 2 * width, static_cast<float>(canvas.corner[1]) + 1.5f * em};
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  std::array<std::string, 5> numbers;
  float text_width = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double position = static_cast<double>(i) / (numbers.size() - 1);
    numbers[i] = fmt::format("{:.3g}", map.scale * (is_signed ? 2 * position - 1 : position));
    text_width = std::max(text_width, ImGui::CalcTextSize(numbers[i].c_str()).x);
  }
  draw_list->AddRectFilled({corner.x - text_width - em, corner.y - em}, {corner.x + 1.5f * width, corner.y + height + em}, colour::overlay,
                           0.4f * em);
  const auto colour_at = [&](float position) {
    const auto [r, g, b] = measure::map_colour(position, is_signed);
    return IM_COL32(r, g, b, 255);
  };
  constexpr int parts = 64;
  for (int part = 0; part < parts; ++part) {
    const float low = static_cast<float>(part) / parts, high = static_cast<float>(part + 1) / parts;
    const ImU32 above = colour_at(high), below = colour_at(low);
    draw_list->AddRectFilledMultiColor({corner.x, corner.y + (1 - high) * height}, {corner.x + width, corner.y + (1 - low) * height}, above,
                                       above, below, below);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const float y = corner.y + height * (1 - static_cast<float>(i) / (numbers.size() - 1));
    const ImVec2 extent = ImGui::CalcTextSize(numbers[i].c_str());
    draw_list->AddText({corner.x - extent.x - 0.4f * em, y - extent.y / 2}, colour::text, numbers[i].c_str());
  }
}

} // namespace nephroid::ui
