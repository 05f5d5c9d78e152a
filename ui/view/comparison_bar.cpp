// SPDX-License-Identifier: Apache-2.0
#include "ui/view/comparison_bar.h"

#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

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
    draw_list->AddText({corner.x - extent.x - 0.4f * em, y - extent.y / 2}, colour::on_dark, numbers[i].c_str());
  }
}

} // namespace nephroid::ui
