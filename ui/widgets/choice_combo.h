// SPDX-License-Identifier: Apache-2.0
// A box that chooses one word of an enumeration of the preset, with the sentences of preset/choices.h.
#pragma once
#include "preset/choices.h"

#include <imgui.h>

#include <string>

namespace nephroid::ui {

/// True where another one was chosen. Wide enough for the longest word.
template <class E>
bool choice_combo(const char* label, E& value)
{
  float width = 0;
  for (const auto& choice : preset::Choices<E>::all) width = std::max(width, ImGui::CalcTextSize(std::string(choice.name).c_str()).x);
  ImGui::SetNextItemWidth(width + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight());
  bool changed = false;
  const bool open = ImGui::BeginCombo(label, std::string(preset::word(value)).c_str());
  for (const auto& choice : preset::Choices<E>::all) {
    if (!open) {
      if (choice.value == value) ImGui::SetItemTooltip("%s", std::string(choice.sentence).c_str());
      continue;
    }
    if (ImGui::Selectable(std::string(choice.name).c_str(), choice.value == value) && choice.value != value) {
      value = choice.value;
      changed = true;
    }
    ImGui::SetItemTooltip("%s", std::string(choice.sentence).c_str());
  }
  if (open) ImGui::EndCombo();
  return changed;
}

} // namespace nephroid::ui
