// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/widgets.h"

#include "base/lower_case.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace nephroid::ui {

void draw_text(std::uint32_t colour, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void draw_wrapped(std::uint32_t colour, const std::string& text) {
  ImGui::PushTextWrapPos(0);
  draw_text(colour, text);
  ImGui::PopTextWrapPos();
}

void draw_label(const char* text) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  ImGui::SameLine();
}

void tooltip(const std::string& text) { ImGui::SetItemTooltip("%s", text.c_str()); }

void draw_hint(std::uint32_t colour, const ImVec2& corner, const ImVec2& size, const std::string& hint) {
  const float wrap = 0.9f * size.x;
  const ImVec2 extent = ImGui::CalcTextSize(hint.c_str(), nullptr, false, wrap);
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, corner + (size - extent) / 2, colour, hint.c_str(), nullptr, wrap);
}

void cell(const std::string& text) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(text.c_str());
}

void heading_cell(const char* text, const char* help) {
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", text);
  tooltip(help);
}

bool has_words(const std::string& text, const std::string& words) {
  const std::string lower_text = lower_case(text);
  std::istringstream wanted(lower_case(words));
  return std::all_of(std::istream_iterator<std::string>(wanted), {},
                     [&](const std::string& word) { return lower_text.find(word) != std::string::npos; });
}

void same_line_if_room(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void draw_rows_in_sight(std::size_t count, const std::function<void(std::size_t)>& draw_row, float height) {
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count), height);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_row(static_cast<std::size_t>(i));
}

void BarRows::bar(const std::function<void()>& draw) {
  const std::size_t index = next_++;
  if (index == widths_.size()) widths_.push_back(0);
  const float gap = 2 * em();
  const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x; // the cursor is at the left
  if (index > 0 && widths_[index] > 0 && right_ + gap + widths_[index] <= end) ImGui::SameLine(0, gap);
  ImGui::BeginGroup();
  draw();
  ImGui::EndGroup();
  right_ = ImGui::GetItemRectMax().x;
  widths_[index] = ImGui::GetItemRectSize().x;
}

void WidgetPlaces::note(const std::string& widget, const std::string& help) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[widget] = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  if (!help.empty()) tooltip(help);
}

Combo::Combo(const char* label, const std::string& shown, WidgetPlaces* places, std::string widget)
    : places_(places), widget_(std::move(widget)),
      open_(ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge)) {
  if (places_) places_->note(widget_);
}

Combo::~Combo() {
  if (open_) ImGui::EndCombo();
}

bool Combo::entry(const std::string& text, bool is_now, const std::string& help) {
  if (!open_) {
    if (is_now && !help.empty()) tooltip(help);
    return false;
  }
  ImGui::PushID(entries_++);
  const bool chosen = ImGui::Selectable(text.c_str(), is_now);
  ImGui::PopID();
  if (places_) places_->note(widget_ + ":" + text);
  if (!help.empty()) tooltip(help);
  return chosen;
}

std::optional<std::array<double, 2>> WidgetPlaces::of(const std::string& widget) const {
  const auto found = places_.find(widget);
  if (found == places_.end()) return std::nullopt;
  return found->second;
}

} // namespace nephroid::ui
