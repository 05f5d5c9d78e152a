// SPDX-License-Identifier: Apache-2.0
#include "ui/view/on_picture.h"

#include "measure/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

/// sRGB-encoded bytes of a position of 0 (the foot) .. 1.
using ScaleColour = std::function<std::array<unsigned char, 3>(float position)>;
/// A text at the left of a position.
using ScaleMark = std::pair<double, std::string>;
/// A colour beside the scale and what it means, below it.
using ScaleKey = std::pair<std::array<unsigned char, 3>, std::string>;

ImU32 opaque(const std::array<unsigned char, 3>& colour) { return IM_COL32(colour[0], colour[1], colour[2], 255); }

void draw_bar(const ImVec2& corner, float width, float height, const ScaleColour& colour_at)
{
  constexpr int parts = 64;
  for (int part = 0; part < parts; ++part) {
    const float low = static_cast<float>(part) / parts, high = static_cast<float>(part + 1) / parts;
    const ImU32 above = opaque(colour_at(high)), below = opaque(colour_at(low));
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor({corner.x, corner.y + (1 - high) * height},
                                                        {corner.x + width, corner.y + (1 - low) * height}, above, above, below, below);
  }
}

/// A scale of colours with its numbers, along the right edge of the picture. title: above; may be empty.
void draw_scale(const Canvas& canvas, const std::string& title, std::span<const ScaleMark> marks, const ScaleColour& colour_at,
                std::span<const ScaleKey> keys = {})
{
  const float em = ImGui::GetFontSize(), width = em, line = 1.2f * em;
  const float head = title.empty() ? 0 : line, foot = line * static_cast<float>(keys.size());
  const float height = std::max(std::min(16 * em, 0.7f * static_cast<float>(canvas.size[1]) - head - foot), 2 * em);
  const ImVec2 corner{static_cast<float>(canvas.corner[0] + canvas.size[0]) - 2 * width,
                      static_cast<float>(canvas.corner[1]) + 1.5f * em + head};
  float text_width = ImGui::CalcTextSize(title.c_str()).x - 2 * width;
  for (const auto& [position, text] : marks) text_width = std::max(text_width, ImGui::CalcTextSize(text.c_str()).x);
  for (const auto& [colour, text] : keys) text_width = std::max(text_width, ImGui::CalcTextSize(text.c_str()).x);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddRectFilled({corner.x - text_width - em, corner.y - em - head}, {corner.x + 1.5f * width, corner.y + height + em + foot},
                           colour::overlay, 0.4f * em);
  const auto draw_text = [&](const std::string& text, float right, float middle) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw_list->AddText({right - extent.x, middle - extent.y / 2}, colour::on_dark, text.c_str());
  };
  draw_bar(corner, width, height, colour_at);
  if (!title.empty()) draw_text(title, corner.x + width, corner.y - head);
  for (const auto& [position, text] : marks) draw_text(text, corner.x - 0.4f * em, corner.y + height * static_cast<float>(1 - position));
  float y = corner.y + height + em;
  for (const auto& [colour, text] : keys) {
    draw_list->AddRectFilled({corner.x, y - 0.4f * em}, {corner.x + width, y + 0.4f * em}, opaque(colour));
    draw_text(text, corner.x - 0.4f * em, y);
    y += line;
  }
}

} // namespace

void draw_overlay(const ImVec2& at, const std::string& text)
{
  const float pad = ImGui::GetFontSize() * 0.4f;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddRectFilled(at, {at.x + extent.x + 2 * pad, at.y + extent.y + 2 * pad}, colour::overlay, pad);
  draw_list->AddText({at.x + pad, at.y + pad}, colour::on_dark, text.c_str());
}

void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas)
{
  const double low = std::log10(range.low), high = std::log10(range.high);
  std::vector<ScaleMark> marks{{0, fmt::format("{:.3g}", range.low)}, {1, fmt::format("{:.3g}", range.high)}};
  for (int decade = static_cast<int>(std::ceil(low)); decade <= high; ++decade) // numbers that would touch the ends are left out
    if (const double position = (decade - low) / (high - low); position > 0.06 && position < 0.94)
      marks.emplace_back(position, fmt::format("{:.3g}", std::pow(10.0, decade)));
  if (marks.size() > 12) marks.resize(2);
  const std::array keys{ScaleKey{negative_colour, "negative"}, ScaleKey{infinite_colour, "infinite"}, ScaleKey{nan_colour, "NaN"}};
  draw_scale(
      canvas, "W/m2/sr", marks, [](float position) { return measure::map_colour(static_cast<double>(position)); }, keys);
}

void draw_difference_scale(const ShownDifference& map, const Canvas& canvas)
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
