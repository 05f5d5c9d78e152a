// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/panels.h"

#include "preset/settings_type.h"
#include "ui/annealing/panel.h"
#include "ui/dispersion/panel.h"
#include "ui/environment/panel.h"
#include "ui/error/panel.h"
#include "ui/inspector/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/presets/panel.h"
#include "ui/runs/panel.h"
#include "ui/spectra/panel.h"
#include "ui/view/panel.h"
#include "ui/view/picking.h"

#include <imgui.h>
#include <imgui_internal.h>

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
    {"view", ViewPanel::title, "", make<ViewPanel>, SeenScene::look},
    {"error", ErrorPanel::title, "", make<ErrorPanel>},
    {"parameters", ParametersPanel::title, "", make<ParametersPanel>},
    {"runs", RunsPanel::title, "", make<RunsPanel>},
    {"dispersion", DispersionPanel::title, "spectral", make<DispersionPanel>},
    {"spectra", SpectraPanel::title, "spectral", make<SpectraPanel>,
     [](const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded) {
       return SeenByGlass::look(preset, loaded->scene, *loaded->bvh);
     }},
    {"annealing", AnnealingPanel::title, "inverse", make<AnnealingPanel>, nullptr, nullptr, "inverse"},
    {"environment", EnvironmentPanel::title, "", make<EnvironmentPanel>, nullptr, EnvironmentPanel::serves, "environment"},
    {"inspector", InspectorPanel::title, "", make<InspectorPanel>},
    {"plan", PlanPanel::title, "", make<PlanPanel>},
    {"presets", PresetsPanel::title, "", make<PresetsPanel>},
};

} // namespace

std::span<const PanelEntry> panel_table() { return table; }

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
  return entry.engine.empty() || entry.engine == preset.settings.type().name;
}

std::vector<std::any> look_around(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded)
{
  std::vector<std::any> seen;
  for (const PanelEntry& entry : table)
    if (entry.look_around && serves(entry, preset)) seen.push_back(entry.look_around(preset, loaded));
  return seen;
}

} // namespace nephroid::ui
