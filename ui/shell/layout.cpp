// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/layout.h"

#include "base/error.h"
#include "ui/dispersion/panel.h"
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/spectra/panel.h"
#include "ui/view/panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

namespace nephroid::ui {
namespace {

struct Layout {
  std::string_view name;
  const char* in_front; ///< of the tabs at the right
  bool fields_below;    ///< Parameters is under the picture: fields and the curves that follow them are in sight together
};

constexpr Layout layouts[] = {{"default", ErrorPanel::title, false},
                              {"dispersion", DispersionPanel::title, true},
                              {"spectra", SpectraPanel::title, true},
                              {"plan", PlanPanel::title, false},
                              {"parameters", ParametersPanel::title, false}};

const Layout* find(const std::string& name)
{
  const auto found = std::find_if(std::begin(layouts), std::end(layouts), [&](const Layout& l) { return l.name == name; });
  return name.empty() ? &layouts[0] : found == std::end(layouts) ? nullptr : &*found;
}

} // namespace

void check_layout(const std::string& name)
{
  if (find(name)) return;
  std::string names;
  for (const Layout& layout : layouts) names += (names.empty() ? "" : ", ") + std::string(layout.name);
  throw bad_input("--layout", "there is no layout \"" + name + "\"", "expected one of: " + names);
}

void build_layout(const std::string& name, unsigned dock_space, float width, float height)
{
  check_layout(name);
  ImGui::DockBuilderRemoveNode(dock_space);
  ImGui::DockBuilderAddNode(dock_space, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(dock_space, {width, height});
  // The tabs are as wide as a plot with its legend needs; the picture has the rest.
  const float tabs = std::clamp(ImGui::GetFontSize() * 28, 0.3f * width, 0.45f * width);
  ImGuiID left = 0;
  const ImGuiID right = ImGui::DockBuilderSplitNode(dock_space, ImGuiDir_Right, tabs / std::max(width, 1.0f), nullptr, &left);
  ImGuiID fields = right;
  if (find(name)->fields_below) fields = ImGui::DockBuilderSplitNode(left, ImGuiDir_Down, 0.42f, nullptr, &left);
  ImGui::DockBuilderDockWindow(ViewPanel::title, left);
  ImGui::DockBuilderDockWindow(ErrorPanel::title, right);
  ImGui::DockBuilderDockWindow(ParametersPanel::title, fields);
  for (const char* title : {DispersionPanel::title, SpectraPanel::title, PlanPanel::title}) ImGui::DockBuilderDockWindow(title, right);
  // A tab's identifier is that of its window's name in its window (ImGuiWindow::TabId).
  ImGui::DockBuilderGetNode(right)->SelectedTabId = ImHashStr("#TAB", 0, ImHashStr(find(name)->in_front));
  ImGui::DockBuilderFinish(dock_space);
}

} // namespace nephroid::ui
