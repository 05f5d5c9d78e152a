// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/layout.h"

#include "base/error.h"
#include "ui/shell/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <set>

namespace nephroid::ui {
namespace {

std::span<const PanelEntry> tabs() { return panel_table().subspan(1); }

/// The panel of a name; null where there is none.
const PanelEntry* find_panel(const std::string& name)
{
  const auto found = std::find_if(panel_table().begin(), panel_table().end(), [&](const PanelEntry& entry) { return entry.name == name; });
  return found == panel_table().end() ? nullptr : &*found;
}

/// The tab in front; null where there is no such layout.
const PanelEntry* front_tab(const std::string& name, const std::string& engine)
{
  if (!name.empty()) return name == panel_table().front().name ? nullptr : find_panel(name);
  const auto own =
      std::find_if(tabs().begin(), tabs().end(), [&](const PanelEntry& tab) { return !engine.empty() && tab.front_for == engine; });
  return own == tabs().end() ? &tabs().front() : &*own;
}

/// A tab's identifier is that of its window's name in its window (ImGuiWindow::TabId).
ImGuiID tab_id(const char* title) { return ImHashStr("#TAB", 0, ImHashStr(title)); }

class Docking {
public:
  void build(const Dock& dock, ImGuiID node)
  {
    if (dock.split == Dock::Split::none) return build_tabs(dock, node);
    ImGuiID second = 0;
    const ImGuiID first = ImGui::DockBuilderSplitNode(node, dock.split == Dock::Split::columns ? ImGuiDir_Left : ImGuiDir_Up,
                                                      static_cast<float>(dock.first_part), nullptr, &second);
    build(dock.parts[0], first);
    build(dock.parts[1], second);
  }
  /// Those that float are not docked.
  void let_float(const std::vector<Floating>& all)
  {
    for (const Floating& one : all)
      if (const PanelEntry* entry = find_panel(one.panel); entry && placed_.insert(one.panel).second)
        ImGui::DockBuilderDockWindow(entry->title, 0);
  }
  void build_rest()
  {
    for (const PanelEntry& entry : panel_table())
      if (!placed_.contains(std::string(entry.name))) ImGui::DockBuilderDockWindow(entry.title, tabs_ ? tabs_ : any_);
  }

private:
  void build_tabs(const Dock& dock, ImGuiID node)
  {
    any_ = node;
    for (const std::string& name : dock.tabs) {
      const PanelEntry* entry = find_panel(name);
      if (!entry || !placed_.insert(name).second) continue;
      ImGui::DockBuilderDockWindow(entry->title, node);
      if (!tabs_ && entry != &panel_table().front()) tabs_ = node;
    }
    if (const PanelEntry* front = find_panel(dock.front)) ImGui::DockBuilderGetNode(node)->SelectedTabId = tab_id(front->title);
  }

  std::set<std::string> placed_;
  ImGuiID tabs_ = 0; ///< the first place that has more than the picture,
  ImGuiID any_ = 0;  ///< and some place
};

/// The node that a panel's window is docked in, also while it is not drawn; 0: none.
ImGuiID dock_of(const PanelEntry& entry)
{
  if (const ImGuiWindow* window = ImGui::FindWindowByName(entry.title)) return window->DockId;
  const ImGuiWindowSettings* settings = ImGui::FindWindowSettingsByID(ImHashStr(entry.title));
  return settings ? settings->DockId : 0;
}

Dock read_node(const ImGuiDockNode& node)
{
  Dock dock;
  if (node.IsSplitNode()) {
    const ImGuiAxis axis = node.SplitAxis;
    dock.split = axis == ImGuiAxis_X ? Dock::Split::columns : Dock::Split::rows;
    // SizeRef: what was asked for, also where one of the two has nothing to show now.
    const float first = node.ChildNodes[0]->SizeRef[axis], second = node.ChildNodes[1]->SizeRef[axis];
    if (first + second > 0) dock.first_part = std::clamp<double>(first / (first + second), Dock::smallest_part, 1 - Dock::smallest_part);
    dock.parts = {read_node(*node.ChildNodes[0]), read_node(*node.ChildNodes[1])};
    return dock;
  }
  std::vector<std::pair<int, const PanelEntry*>> in_order; // what is not drawn comes last
  for (const PanelEntry& entry : panel_table()) {
    if (dock_of(entry) != node.ID) continue;
    int order = node.Windows.Size;
    for (int i = 0; i < node.Windows.Size; ++i)
      if (entry.title == std::string_view(node.Windows[i]->Name)) order = i;
    in_order.emplace_back(order, &entry);
    if (tab_id(entry.title) == node.SelectedTabId) dock.front = entry.name;
  }
  std::stable_sort(in_order.begin(), in_order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [order, entry] : in_order) dock.tabs.emplace_back(entry->name);
  return dock;
}

} // namespace

void check_layout(const std::string& name)
{
  if (front_tab(name, "")) return;
  std::string names;
  for (const PanelEntry& tab : tabs()) names += (names.empty() ? "" : ", ") + std::string(tab.name);
  throw bad_input("--layout", "there is no layout \"" + name + "\"", "expected one of: " + names);
}

Layout starting_layout(const std::string& name, const std::string& engine, float width)
{
  check_layout(name);
  const PanelEntry& front = *front_tab(name, engine);
  Dock picture{.tabs = {std::string(panel_table().front().name)}}, fields{.tabs = {}},
      at_right{.tabs = {}, .front = std::string(front.name)};
  // Beside what an engine's own panel shows the fields are under the picture, so that both are in sight together.
  const bool fields_below = !front.engine.empty();
  const auto is_below = [&](const PanelEntry& tab) { return fields_below && (tab.name == "parameters" || tab.name == "presets"); };
  for (const PanelEntry& tab : tabs()) (is_below(tab) ? fields : at_right).tabs.emplace_back(tab.name);
  Dock left = picture;
  if (fields_below) left = {.split = Dock::Split::rows, .first_part = 0.58, .parts = {picture, fields}};
  // The tabs are as wide as a plot with its legend needs; the picture has the rest.
  const float tab_width = std::clamp(ImGui::GetFontSize() * 28, 0.3f * width, 0.45f * width);
  return {{.split = Dock::Split::columns, .first_part = 1 - tab_width / std::max(width, 1.0f), .parts = {left, at_right}}, {}};
}

void apply_layout(const Layout& layout, unsigned dock_space, float width, float height)
{
  ImGui::DockBuilderRemoveNode(dock_space);
  ImGui::DockBuilderAddNode(dock_space, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(dock_space, {width, height});
  Docking docking;
  docking.build(layout.docks, dock_space);
  docking.let_float(layout.floating);
  docking.build_rest();
  ImGui::DockBuilderFinish(dock_space);
}

void bring_to_front(const Dock& dock)
{
  for (const Dock& part : dock.parts) bring_to_front(part);
  const PanelEntry* front = find_panel(dock.front);
  const ImGuiWindow* window = front ? ImGui::FindWindowByName(front->title) : nullptr;
  if (!window || !window->DockNode) return;
  window->DockNode->SelectedTabId = window->TabId;
  if (window->DockNode->TabBar) window->DockNode->TabBar->NextSelectedTabId = window->TabId;
}

void place_next(const Floating& floating)
{
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const auto part = [&](std::size_t i) { return static_cast<float>(floating.place[i]) * (i % 2 == 0 ? viewport.Size.x : viewport.Size.y); };
  ImGui::SetNextWindowPos({viewport.Pos.x + part(0), viewport.Pos.y + part(1)});
  ImGui::SetNextWindowSize({part(2), part(3)});
}

Layout layout_now(unsigned dock_space)
{
  Layout layout;
  if (const ImGuiDockNode* node = ImGui::DockBuilderGetNode(dock_space)) layout.docks = read_node(*node);
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  for (const PanelEntry& entry : panel_table()) {
    const ImGuiWindow* window = ImGui::FindWindowByName(entry.title);
    if (!window || !window->WasActive || window->DockId != 0) continue;
    const auto part = [](float length, float whole) { return std::clamp(static_cast<double>(length) / std::max(whole, 1.0f), -1.0, 2.0); };
    layout.floating.push_back(
        {std::string(entry.name),
         {part(window->Pos.x - viewport.Pos.x, viewport.Size.x), part(window->Pos.y - viewport.Pos.y, viewport.Size.y),
          part(window->SizeFull.x, viewport.Size.x), part(window->SizeFull.y, viewport.Size.y)}});
  }
  return layout;
}

} // namespace nephroid::ui
