// SPDX-License-Identifier: Apache-2.0
// The table of panels, a line each. The first is the picture; shell/layout.h says where the others are.
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
  /// The engine whose presets are opened with this tab in front; empty: none.
  std::string_view front_for = "";
};

/// In the order of their tabs.
std::span<const PanelEntry> panel_table();
/// All but the picture can be closed.
bool can_close(const PanelEntry& entry);
/// Whether a person has not closed it for the engine in hand.
bool is_open(const PanelEntry& entry, const Context& context);
/// Whether it was drawn in the last frame: a tab behind another is open and not seen.
bool is_seen(const PanelEntry& entry);
/// Whether the panel is for this preset.
bool serves(const PanelEntry& entry, const preset::Preset& preset);
/// What the panels of the preset's engine look for in a scene (LookAround of state/device_runs.h).
std::vector<std::any> look_around(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded);

} // namespace nephroid::ui
