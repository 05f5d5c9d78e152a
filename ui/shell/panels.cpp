// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/panels.h"

#include "base/error.h"
#include "ui/error/panel.h"
#include "ui/inspector/panel.h"
#include "ui/meters/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/presets/panel.h"
#include "ui/runs/panel.h"
#include "ui/view/panel.h"
#include "ui/view/pinhole.h"

#include <imgui_internal.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

/// Those of an engine stand together, in the middle.
std::vector<PanelEntry> make_table() {
  std::vector<PanelEntry> table{{"view", ViewPanel::title, "", make_panel<ViewPanel>, ViewedScene::take},
                                {"error", ErrorPanel::title, "", make_panel<ErrorPanel>},
                                {"parameters", ParametersPanel::title, "", make_panel<ParametersPanel>},
                                {"runs", RunsPanel::title, "", make_panel<RunsPanel>}};
  for (const auto panels_of_engine : {
           spectral_panels,
           inverse_panels,
           environment_panels,
       })
    for (const PanelEntry& entry : panels_of_engine()) table.push_back(entry);
  PanelEntry meters{"meters", MetersPanel::title, "", make_panel<MetersPanel>};
  meters.serves = [](const preset::Preset& preset) { return !preset.scene.meters.empty(); };
  table.push_back(meters);
  table.insert(table.end(), {{"inspector", InspectorPanel::title, "", make_panel<InspectorPanel>},
                             {"plan", PlanPanel::title, "", make_panel<PlanPanel>},
                             {"presets", PresetsPanel::title, "", make_panel<PresetsPanel>}});
  return table;
}

std::span<const PanelEntry> tabs() { return panel_table().subspan(1); }

/// The tab in front; null where there is no such layout.
const PanelEntry* front_tab(const std::string& name, const std::string& engine) {
  const auto front = name.empty() ? std::ranges::find(tabs(), engine, &PanelEntry::front_for)
                                  : std::ranges::find(tabs(), name, &PanelEntry::name);
  if (front != tabs().end() && (!name.empty() || !engine.empty())) return &*front;
  return name.empty() ? &tabs().front() : nullptr;
}

/// A tab's identifier is that of its window's name in its window (ImGuiWindow::TabId).
ImGuiID tab_id(const char* title) { return ImHashStr("#TAB", 0, ImHashStr(title)); }

} // namespace

std::span<const PanelEntry> panel_table() {
  static const std::vector<PanelEntry> table = make_table();
  return table;
}

bool can_close(const PanelEntry& entry) { return entry.name != panel_table().front().name; }

bool is_open(const PanelEntry& entry, const Context& context) {
  const auto engine_layout = context.settings.engines.find(context.engine());
  return engine_layout == context.settings.engines.end() ||
         !engine_layout->second.closed.contains(std::string(entry.name));
}

bool is_seen(const PanelEntry& entry) {
  const ImGuiWindow* window = ImGui::FindWindowByName(entry.title);
  return window && window->WasActive && !window->Hidden &&
         (!window->DockNode || window->DockNode->VisibleWindow == window);
}

bool serves(const PanelEntry& entry, const preset::Preset& preset) {
  if (entry.serves) return entry.serves(preset);
  return entry.engine.empty() || entry.engine == preset.settings.engine();
}

SceneFacts take_facts(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded) {
  SceneFacts facts;
  for (const PanelEntry& entry : panel_table())
    if (entry.take_facts && serves(entry, preset)) entry.take_facts(preset, loaded, facts);
  return facts;
}

void check_layout(const std::string& name) {
  if (front_tab(name, "")) return;
  std::string names;
  for (const PanelEntry& tab : tabs()) names += (names.empty() ? "" : ", ") + std::string(tab.name);
  throw bad_input("--layout", "there is no layout \"" + name + "\"", "expected one of: " + names);
}

FrontTabs panels_in_sight() {
  FrontTabs tabs;
  for (const PanelEntry& entry : panel_table())
    if (is_seen(entry)) tabs.push_back(tab_id(entry.title));
  return tabs;
}

FrontTabs begin_layout(const std::string& name, const preset::Preset& preset, unsigned dock_space, float width,
                       float height) {
  check_layout(name);
  const PanelEntry& front = *front_tab(name, std::string(preset.settings.engine()));
  ImGui::DockBuilderRemoveNode(dock_space);
  ImGui::DockBuilderAddNode(dock_space, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(dock_space, {width, height});
  if (width < 40 * em()) { // too narrow for two docks: all are tabs of one, by default the picture in front
    for (const PanelEntry& entry : panel_table()) ImGui::DockBuilderDockWindow(entry.title, dock_space);
    ImGui::DockBuilderFinish(dock_space);
    return {tab_id(name.empty() ? panel_table().front().title : front.title)};
  }
  // Beside what an engine's own panel shows the fields are under the picture, so that both are in sight together.
  const bool fields_below = !front.engine.empty();
  const auto is_below = [&](const PanelEntry& tab) {
    return fields_below && (tab.name == "parameters" || tab.name == "presets");
  };
  // The tabs are as wide as a plot with its legend needs and, where the window has room for that, as their titles; the
  // picture has the rest. The widest tabs give up the room of their close buttons first.
  const float most = 0.45f * width;
  float longest = 0, titles = em();
  std::vector<const char*> beside;
  for (const PanelEntry& tab : tabs())
    if (serves(tab, preset) && !is_below(tab)) beside.push_back(tab.title);
  for (const char* title : beside) longest = std::max(longest, ImGui::TabItemCalcSize(title, false).x);
  for (const char* title : beside)
    titles += std::min(ImGui::TabItemCalcSize(title, true).x, longest) + ImGui::GetStyle().ItemInnerSpacing.x;
  const float tab_width = std::clamp(std::max(28 * em(), titles <= most ? titles : 0), 0.3f * width, most);
  ImGuiID at_right = 0, below = 0;
  ImGuiID picture =
      ImGui::DockBuilderSplitNode(dock_space, ImGuiDir_Left, 1 - tab_width / std::max(width, 1.0f), nullptr, &at_right);
  if (fields_below) picture = ImGui::DockBuilderSplitNode(picture, ImGuiDir_Up, 0.58f, nullptr, &below);
  ImGui::DockBuilderDockWindow(panel_table().front().title, picture);
  for (const PanelEntry& tab : tabs()) ImGui::DockBuilderDockWindow(tab.title, is_below(tab) ? below : at_right);
  ImGui::DockBuilderGetNode(at_right)->SelectedTabId = tab_id(front.title);
  ImGui::DockBuilderFinish(dock_space);
  return {tab_id(front.title)};
}

FrontTabs restore_layout(const std::string& ini) {
  ImGui::LoadIniSettingsFromMemory(ini.data(), ini.size());
  const ImGuiWindowSettings* first = ImGui::FindWindowSettingsByID(ImHashStr(tabs().front().title));
  for (const PanelEntry& entry : panel_table())
    if (ini.find(std::string("[Window][") + entry.title + "]\n") == std::string::npos)
      ImGui::DockBuilderDockWindow(entry.title, first ? first->DockId : 0);
  FrontTabs front;
  for (const ImGuiStoragePair& node : ImGui::GetCurrentContext()->DockContext.Nodes.Data)
    if (node.val_p) front.push_back(static_cast<const ImGuiDockNode*>(node.val_p)->SelectedTabId);
  return front;
}

void bring_to_front(const FrontTabs& front) {
  for (const PanelEntry& entry : panel_table()) {
    const ImGuiWindow* window = ImGui::FindWindowByName(entry.title);
    if (!window || !window->DockNode || std::ranges::count(front, window->TabId) == 0) continue;
    window->DockNode->SelectedTabId = window->TabId;
    if (window->DockNode->TabBar) window->DockNode->TabBar->NextSelectedTabId = window->TabId;
  }
}

std::string layout_now() { return ImGui::SaveIniSettingsToMemory(); }

} // namespace nephroid::ui
