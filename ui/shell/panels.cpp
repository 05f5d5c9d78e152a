// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/panels.h"

#include "base/error.h"
#include "preset/settings_type.h"
#include "ui/annealing/panel.h"
#include "ui/dispersion/panel.h"
#include "ui/environment/panel.h"
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/presets/panel.h"
#include "ui/spectra/panel.h"
#include "ui/view/panel.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <type_traits>

namespace nephroid::ui {
namespace {

template <class P>
std::unique_ptr<Panel> make([[maybe_unused]] WavelengthAxis& wavelengths)
{
  if constexpr (std::is_constructible_v<P, WavelengthAxis&>)
    return std::make_unique<P>(wavelengths);
  else
    return std::make_unique<P>();
}

const PanelEntry table[] = {
    {"view", ViewPanel::title, "", make<ViewPanel>},
    {"error", ErrorPanel::title, "", make<ErrorPanel>},
    {"dispersion", DispersionPanel::title, "spectral", make<DispersionPanel>},
    {"spectra", SpectraPanel::title, "spectral", make<SpectraPanel>, SeenByGlass::look},
    {"annealing", AnnealingPanel::title, "inverse", make<AnnealingPanel>},
    {"environment", EnvironmentPanel::title, "", make<EnvironmentPanel>, nullptr, EnvironmentPanel::serves},
    {"plan", PlanPanel::title, "", make<PlanPanel>},
    {"parameters", ParametersPanel::title, "", make<ParametersPanel>},
    {"presets", PresetsPanel::title, "", make<PresetsPanel>},
};

std::span<const PanelEntry> tabs() { return panel_table().subspan(1); }

/// The tab in front; null where there is no such layout.
const PanelEntry* find(const std::string& name)
{
  if (name.empty() || name == "default") return &tabs().front();
  const auto found = std::find_if(tabs().begin(), tabs().end(), [&](const PanelEntry& tab) { return tab.name == name; });
  return found == tabs().end() ? nullptr : &*found;
}

} // namespace

std::span<const PanelEntry> panel_table() { return table; }

bool serves(const PanelEntry& entry, const preset::Preset* preset)
{
  if (preset && entry.serves) return entry.serves(*preset);
  return !preset || entry.engine.empty() || entry.engine == preset->settings.type().name;
}

std::vector<std::any> look_around(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
{
  std::vector<std::any> seen;
  for (const PanelEntry& entry : table)
    if (entry.look_around && serves(entry, &preset)) seen.push_back(entry.look_around(preset, scene, bvh));
  return seen;
}

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
  for (const PanelEntry& tab : tabs())
    ImGui::DockBuilderDockWindow(tab.title, tab.name == "parameters" || tab.name == "presets" ? fields : right);
  ImGui::DockBuilderDockWindow(panel_table().front().title, left);
  // A tab's identifier is that of its window's name in its window (ImGuiWindow::TabId).
  ImGui::DockBuilderGetNode(right)->SelectedTabId = ImHashStr("#TAB", 0, ImHashStr(front.title));
  ImGui::DockBuilderFinish(dock_space);
}

} // namespace nephroid::ui
