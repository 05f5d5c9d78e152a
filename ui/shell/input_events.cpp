// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/input_events.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <vector>

namespace nephroid::ui {
namespace {

bool is_modifier(ImGuiKey key) { return (key & ImGuiMod_Mask_) != 0 || ImGui::IsLRModKey(key); }

bool is_press(const ImGuiInputEvent& event)
{
  if (event.Type == ImGuiInputEventType_Key) return event.Key.Down && !is_modifier(event.Key.Key);
  return event.Type == ImGuiInputEventType_MouseWheel; // a click's modifier Dear ImGui itself keeps
}

bool lets_modifier_go(const ImGuiInputEvent& event)
{
  return event.Type == ImGuiInputEventType_Key && !event.Key.Down && is_modifier(event.Key.Key);
}

} // namespace

void new_frame()
{
  ImVector<ImGuiInputEvent>& events = ImGui::GetCurrentContext()->InputEventsQueue;
  ImGuiInputEvent* const later = std::find_if(std::find_if(events.begin(), events.end(), is_press), events.end(), lets_modifier_go);
  const std::vector<ImGuiInputEvent> kept(later, events.end());
  events.resize(static_cast<int>(later - events.begin()));
  ImGui::NewFrame();
  for (const ImGuiInputEvent& event : kept) events.push_back(event);
}

} // namespace nephroid::ui
