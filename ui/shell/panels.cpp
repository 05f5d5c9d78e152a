// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/panels.h"

#include "ui/error/panel.h"
#include "ui/inspector/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/presets/panel.h"
#include "ui/runs/panel.h"
#include "ui/view/panel.h"
#include "ui/view/sight.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <vector>

namespace nephroid::ui {
namespace {

/// Those of an engine stand together, in the middle.
std::vector<PanelEntry> make_table()
{
  std::vector<PanelEntry> table{{"view", ViewPanel::title, "", make_panel<ViewPanel>, SeenScene::look},
                                {"error", ErrorPanel::title, "", make_panel<ErrorPanel>},
                                {"parameters", ParametersPanel::title, "", make_panel<ParametersPanel>},
                                {"runs", RunsPanel::title, "", make_panel<RunsPanel>}};
  for (const auto panels_of_engine : {
           spectral_panels,
           inverse_panels,
           environment_panels,
       })
    for (const PanelEntry& entry : panels_of_engine()) table.push_back(entry);
  table.insert(table.end(), {{"inspector", InspectorPanel::title, "", make_panel<InspectorPanel>},
                             {"plan", PlanPanel::title, "", make_panel<PlanPanel>},
                             {"presets", PresetsPanel::title, "", make_panel<PresetsPanel>}});
  return table;
}

} // namespace

std::span<const PanelEntry> panel_table()
{
  static const std::vector<PanelEntry> table = make_table();
  return table;
}

bool can_close(const PanelEntry& entry) { return entry.name != panel_table().front().name; }

bool is_open(const PanelEntry& entry, const Context& context)
{
  const auto of_engine = context.settings.engines.find(context.engine());
  return of_engine == context.settings.engines.end() || !of_engine->second.closed.contains(std::string(entry.name));
}

bool is_seen(const PanelEntry& entry)
{
  const ImGuiWindow* window = ImGui::FindWindowByName(entry.title);
  return window && window->WasActive && !window->Hidden && (!window->DockNode || window->DockNode->VisibleWindow == window);
}

bool serves(const PanelEntry& entry, const preset::Preset& preset)
{
  if (entry.serves) return entry.serves(preset);
  return entry.engine.empty() || entry.engine == preset.settings.engine();
}

std::vector<std::any> look_around(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded)
{
  std::vector<std::any> seen;
  for (const PanelEntry& entry : panel_table())
    if (entry.look_around && serves(entry, preset)) seen.push_back(entry.look_around(preset, loaded));
  return seen;
}

} // namespace nephroid::ui
