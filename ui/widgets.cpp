// SPDX-License-Identifier: Apache-2.0
#include "ui/widgets.h"

#include "ui/theme.h"

#include <imgui.h>

namespace nephroid::ui {
namespace {

int resize(ImGuiInputTextCallbackData* data)
{
  if (data->EventFlag != ImGuiInputTextFlags_CallbackResize) return 0;
  auto* text = static_cast<std::string*>(data->UserData);
  text->resize(static_cast<std::size_t>(data->BufTextLen));
  data->Buf = text->data();
  return 0;
}

} // namespace

bool input_text(const char* label, const char* hint, std::string& text, int flags)
{
  return ImGui::InputTextWithHint(label, hint, text.data(), text.capacity() + 1, flags | ImGuiInputTextFlags_CallbackResize, resize, &text);
}

void draw_wrapped(std::uint32_t colour, const std::string& text)
{
  ImGui::PushTextWrapPos(0);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
}

void draw_hint(const ImVec2& corner, const ImVec2& size, const std::string& hint)
{
  const float wrap = 0.9f * size.x;
  const ImVec2 extent = ImGui::CalcTextSize(hint.c_str(), nullptr, false, wrap);
  const ImVec2 at{corner.x + (size.x - extent.x) / 2, corner.y + (size.y - extent.y) / 2};
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, at, colour::quiet_text, hint.c_str(), nullptr, wrap);
}

} // namespace nephroid::ui
