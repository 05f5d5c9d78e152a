// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets/material_choice.h"

#include "ui/widgets/theme.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// n_d and V_d, as catalogues of glass have them.
std::string figures_of(const scatter::ShippedMaterial& material) {
  if (material.metal || !material.n_d) return {};
  return fmt::format("n_d {:.4f}", *material.n_d) + (material.abbe ? fmt::format("   V_d {:.1f}", *material.abbe) : "");
}

} // namespace

void MaterialChoice::begin(TaskQueue& tasks) {
  words_.clear();
  marked_ = 0;
  if (was_read_ || tasks.busy(reading_)) return;
  tasks.start(reading_, {"reading the shipped materials"}, scatter::read_shipped_materials,
              [this](std::vector<scatter::ShippedMaterial> shipped) {
                shipped_ = std::move(shipped);
                was_read_ = true;
              });
}

std::optional<std::string> MaterialChoice::draw(const std::string& widget, Kind kind, const std::string& now,
                                                TaskQueue& tasks, WidgetPlaces& places) {
  const std::string popup = "shipped" + widget;
  if (ImGui::ArrowButton(("##" + popup).c_str(), ImGuiDir_Down)) {
    begin(tasks);
    ImGui::OpenPopup(popup.c_str());
  }
  places.note(widget + ":shipped", kind == Kind::metal ? "The shipped metals" : "The shipped glasses");
  if (!ImGui::BeginPopup(popup.c_str())) return std::nullopt;
  std::optional<std::string> chosen = draw_list(widget, kind, now, places);
  if (chosen || ImGui::IsKeyPressed(ImGuiKey_Escape, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

std::optional<std::string> MaterialChoice::draw_list(const std::string& widget, Kind kind, const std::string& now,
                                                     WidgetPlaces& places) {
  const float width = 22 * em();
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(width);
  const std::string before = words_;
  const bool entered = ImGui::InputTextWithHint("##words", "Search", &words_, ImGuiInputTextFlags_EnterReturnsTrue);
  places.note(widget + ":words");
  std::size_t count = 0;
  std::vector<const scatter::ShippedMaterial*> matches;
  for (const scatter::ShippedMaterial& material : shipped_) {
    if (material.metal != (kind == Kind::metal)) continue;
    ++count;
    if (has_words(material.name + " " + figures_of(material), words_)) matches.push_back(&material);
  }
  bool moved = before != words_;
  if (moved) marked_ = 0;
  if (ImGui::IsKeyPressed(ImGuiKey_DownArrow) && marked_ + 1 < matches.size()) moved = ++marked_ > 0;
  if (ImGui::IsKeyPressed(ImGuiKey_UpArrow) && marked_ > 0) moved = --marked_ + 1 > 0;
  std::optional<std::string> chosen;
  if (entered && marked_ < matches.size()) chosen = matches[marked_]->name;
  // The arrows move in the list while the text field has the keyboard.
  const float rows = static_cast<float>(std::clamp<std::size_t>(count, 1, 14)); // as high whatever is typed
  if (ImGui::BeginChild("list", {width, rows * ImGui::GetTextLineHeightWithSpacing()}, ImGuiChildFlags_None,
                        ImGuiWindowFlags_NoNav)) {
    if (!was_read_)
      ImGui::TextDisabled("Reading the files");
    else if (matches.empty())
      ImGui::TextDisabled("Nothing of this name comes with the program");
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const std::string& name = matches[i]->name;
      if (name == now) ImGui::PushStyleColor(ImGuiCol_Text, colour::note);
      if (ImGui::Selectable(name.c_str(), i == marked_)) chosen = name;
      if (name == now) ImGui::PopStyleColor();
      places.note(fmt::format("{}:{}", widget, name));
      if (i == marked_ && moved) ImGui::SetScrollHereY();
      if (const std::string figures = figures_of(*matches[i]); !figures.empty()) {
        ImGui::SameLine(10 * em());
        ImGui::TextDisabled("%s", figures.c_str());
      }
    }
  }
  ImGui::EndChild();
  return chosen;
}

} // namespace nephroid::ui
