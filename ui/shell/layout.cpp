// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/layout.h"

#include "base/error.h"
#include "ui/shell/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

std::span<const PanelEntry> tabs() { return panel_table().subspan(1); }

/// The tab in front; null where there is no such layout.
const PanelEntry* find(const std::string& name)
{
  if (name.empty() || name == "default") return &tabs().front();
  const auto found = std::find_if(tabs().begin(), tabs().end(), [&](const PanelEntry& tab) { return tab.name == name; });
  return found == tabs().end() ? nullptr : &*found;
}

} // namespace

void check_layout(const std::string& name)
{
  if (find(name)) return;
  std::string names = "default";
  for (const PanelEntry& tab : tabs()) names += ", " + std::string(tab.name);
  throw bad_input("--layout", "there is no layout \"" + name + "\"", "expected one of: " + names);
}

void build_layout(const std::string& name, unsigned dock_space, float width, float height)
{
  check_layout(name);
  ImGui::DockBuilderRemoveNode(dock_space);
  ImGui::DockBuilderAddNode(dock_space, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(dock_space, {width, height});
  // The tabs are as wide as a plot with its legend needs; the picture has the rest.
  const float tab_width = std::clamp(ImGui::GetFontSize() * 28, 0.3f * width, 0.45f * width);
  ImGuiID left = 0;
  const ImGuiID right = ImGui::DockBuilderSplitNode(dock_space, ImGuiDir_Right, tab_width / std::max(width, 1.0f), nullptr, &left);
  // Beside what an engine's own panel shows the fields are under the picture, so that both are in sight together.
  const PanelEntry& front = *find(name);
  const ImGuiID fields = front.engine.empty() ? right : ImGui::DockBuilderSplitNode(left, ImGuiDir_Down, 0.42f, nullptr, &left);
  for (const PanelEntry& tab : tabs()) ImGui::DockBuilderDockWindow(tab.title, tab.name == "parameters" ? fields : right);
  ImGui::DockBuilderDockWindow(panel_table().front().title, left);
  // A tab's identifier is that of its window's name in its window (ImGuiWindow::TabId).
  ImGui::DockBuilderGetNode(right)->SelectedTabId = ImHashStr("#TAB", 0, ImHashStr(front.title));
  ImGui::DockBuilderFinish(dock_space);
}

} // namespace nephroid::ui
