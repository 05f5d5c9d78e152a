// SPDX-License-Identifier: Apache-2.0
// The table of panels: a line each.
#pragma once
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/wavelength_axis.h"

#include <any>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace nephroid::ui {

struct PanelEntry {
  std::string_view name;   ///< of the layout that has it in front; its folder's
  const char* title;       ///< of its tab
  std::string_view engine; ///< whose presets it is for; empty: every preset
  /// wavelengths: the axis that plots of several panels share; outlives the panel.
  std::unique_ptr<Panel> (*make)(WavelengthAxis& wavelengths);
  /// What it wants to know of the loaded scene; called on the thread that made a run ready. Null: nothing.
  std::any (*look_around)(const preset::Preset&, const scene::Scene&, const scene::Bvh&) = nullptr;
};

/// In the order of their tabs; the first has the window's left side for itself.
std::span<const PanelEntry> panel_table();
/// Whether the panel is for this preset; null: none is open, and every panel says what it is for.
bool serves(const PanelEntry& entry, const preset::Preset* preset);
/// What the panels of the preset's engine look for in a scene (LookAround of state/device_runs.h).
std::vector<std::any> look_around(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

} // namespace nephroid::ui
