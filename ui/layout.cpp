// SPDX-License-Identifier: Apache-2.0
#include "ui/layout.h"

#include "base/error.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace nephroid::ui {

void check_layout(const std::string& name)
{
  if (!name.empty() && name != "default") throw bad_input("--layout", "there is no layout \"" + name + "\"", "expected default");
}

void build_layout(const std::string& name, unsigned dock_space, float width, float height)
{
  check_layout(name);
  ImGui::DockBuilderRemoveNode(dock_space);
  ImGui::DockBuilderAddNode(dock_space, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(dock_space, {width, height});
  ImGui::DockBuilderDockWindow("View", dock_space);
  ImGui::DockBuilderFinish(dock_space);
}

} // namespace nephroid::ui
