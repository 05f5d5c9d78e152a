// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/messages.h"

#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"

#include <imgui.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

constexpr std::size_t most_shown = 4; ///< the newest; the others come up when these are dismissed

std::span<const Message> shown(std::span<const Message> all) { return all.last(std::min(all.size(), most_shown)); }

/// Room at the right for the buttons.
float text_width(float width) { return std::max(width - ImGui::GetFontSize() * 12, ImGui::GetFontSize() * 10); }

float line_height(const Message& message, float width)
{
  return std::max(ImGui::CalcTextSize(message.line.c_str(), nullptr, false, text_width(width)).y, ImGui::GetFrameHeight()) +
         ImGui::GetStyle().ItemSpacing.y;
}

} // namespace

float messages_height(const std::vector<Message>& messages, float width)
{
  if (messages.empty()) return 0;
  float height = 2 * ImGui::GetStyle().WindowPadding.y;
  for (const Message& message : shown(messages)) height += line_height(message, width);
  return height;
}

void draw_messages(const std::vector<Message>& messages, const Context& context)
{
  const float width = ImGui::GetWindowWidth(), em = ImGui::GetFontSize();
  for (const Message& message : shown(messages)) {
    ImGui::PushID(static_cast<int>(message.id));
    const float top = ImGui::GetCursorPosY();
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text_width(width));
    ImGui::PushStyleColor(ImGuiCol_Text, message.error ? colour::error : colour::text);
    ImGui::TextUnformatted(message.line.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPos({width - em * 10.5f, top});
    if (message.error) {
      action_button("Open...", context);
      ImGui::SameLine();
    } else
      ImGui::SetCursorPosX(width - em * 5.5f);
    if (ImGui::Button("Dismiss")) context.push(command::Dismiss{message.id});
    ImGui::SetCursorPosY(top + line_height(message, width));
    ImGui::Dummy({0, 0});
    ImGui::PopID();
  }
}

} // namespace nephroid::ui
