// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/colour_scale.h"

#include "measure/difference.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace nephroid::ui {
namespace {

ImU32 opaque(const std::array<unsigned char, 3>& colour) { return IM_COL32(colour[0], colour[1], colour[2], 255); }

void draw_bar(const ImVec2& corner, float width, float height, const ScaleColour& colour_at) {
  constexpr int parts = 64;
  for (int part = 0; part < parts; ++part) {
    const float low = static_cast<float>(part) / parts, high = static_cast<float>(part + 1) / parts;
    const ImU32 above = opaque(colour_at(high)), below = opaque(colour_at(low));
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor({corner.x, corner.y + (1 - high) * height},
                                                        {corner.x + width, corner.y + (1 - low) * height}, above, above,
                                                        below, below);
  }
}

} // namespace

void draw_scale(const ImVec2& area, const ImVec2& size, const std::string& title, std::span<const ScaleMark> marks,
                const ScaleColour& colour_at, std::span<const ScaleKey> keys) {
  const float width = em(), line = 1.2f * em();
  const float head = title.empty() ? 0 : line, foot = line * static_cast<float>(keys.size());
  const float height = std::max(std::min(16 * em(), 0.7f * size.y - head - foot), 2 * em());
  const ImVec2 corner{area.x + size.x - 2 * width, area.y + 1.5f * em() + head};
  float text_width = ImGui::CalcTextSize(title.c_str()).x - 2 * width;
  for (const auto& [position, text] : marks) text_width = std::max(text_width, ImGui::CalcTextSize(text.c_str()).x);
  for (const auto& [colour, text] : keys) text_width = std::max(text_width, ImGui::CalcTextSize(text.c_str()).x);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddRectFilled({corner.x - text_width - em(), corner.y - em() - head},
                           {corner.x + 1.5f * width, corner.y + height + em() + foot}, colour::overlay, 0.4f * em());
  const auto draw_text = [&](const std::string& text, float right, float middle) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw_list->AddText({right - extent.x, middle - extent.y / 2}, colour::on_dark, text.c_str());
  };
  draw_bar(corner, width, height, colour_at);
  if (!title.empty()) draw_text(title, corner.x + width, corner.y - head);
  for (const auto& [position, text] : marks)
    draw_text(text, corner.x - 0.4f * em(), corner.y + height * static_cast<float>(1 - position));
  float y = corner.y + height + em();
  for (const auto& [colour, text] : keys) {
    draw_list->AddRectFilled({corner.x, y - 0.4f * em()}, {corner.x + width, y + 0.4f * em()}, opaque(colour));
    draw_text(text, corner.x - 0.4f * em(), y);
    y += line;
  }
}

void draw_linear_scale(const ImVec2& area, const ImVec2& size, const std::string& title, double high, bool is_signed) {
  constexpr int numbers = 5;
  std::vector<ScaleMark> marks;
  for (int i = 0; i < numbers; ++i) {
    const double position = static_cast<double>(i) / (numbers - 1);
    marks.emplace_back(position, fmt::format("{:.4g}", high * (is_signed ? 2 * position - 1 : position)));
  }
  draw_scale(area, size, title, marks,
             [&](float position) { return measure::map_colour(static_cast<double>(position), is_signed); });
}

} // namespace nephroid::ui
