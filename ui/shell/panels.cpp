// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/panels.h"

#include "preset/settings_type.h"
#include "ui/dispersion/panel.h"
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/spectra/panel.h"
#include "ui/view/panel.h"

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
    {"plan", PlanPanel::title, "", make<PlanPanel>},
    {"parameters", ParametersPanel::title, "", make<ParametersPanel>},
};

} // namespace

std::span<const PanelEntry> panel_table() { return table; }

bool serves(const PanelEntry& entry, const preset::Preset* preset)
{
  return !preset || entry.engine.empty() || entry.engine == preset->settings.type().name;
}

std::vector<std::any> look_around(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
{
  std::vector<std::any> seen;
  for (const PanelEntry& entry : table)
    if (entry.look_around && serves(entry, &preset)) seen.push_back(entry.look_around(preset, scene, bvh));
  return seen;
}

} // namespace nephroid::ui
