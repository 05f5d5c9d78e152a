// SPDX-License-Identifier: Apache-2.0
// The table of panels, a line each, and where they are: the first at the left, the others as tabs at the right. A layout is named after the
// panel that is in front of the tabs.
#pragma once
#include "preset/preset.h"
#include "run/run.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"

#include <any>
#include <memory>
#include <span>
#include <string>
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
  std::any (*look_around)(const preset::Preset&, const std::shared_ptr<const run::LoadedScene>&) = nullptr;
  /// Whether it is for a preset, where the engine does not decide on that. Null: it does.
  bool (*serves)(const preset::Preset&) = nullptr;
};

/// In the order of their tabs.
std::span<const PanelEntry> panel_table();
/// Whether the panel is for this preset; null: none is open, and every panel says what it is for.
bool serves(const PanelEntry& entry, const preset::Preset* preset);
/// What the panels of the preset's engine look for in a scene (LookAround of state/device_runs.h).
std::vector<std::any> look_around(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded);

/// Throws bad_input naming the layouts there are. Empty means the default.
void check_layout(const std::string& name);
/// Docks every panel into the dock space of this id (an ImGuiID). Inside of a frame.
void build_layout(const std::string& name, unsigned dock_space, float width, float height);

} // namespace nephroid::ui
