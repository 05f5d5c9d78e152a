// SPDX-License-Identifier: Apache-2.0
// The table of panels, a line each (widgets/panel_entry.h). The first is the picture; shell/layout.h says where the others are.
#pragma once
#include "preset/preset.h"
#include "run/run.h"
#include "ui/widgets/panel_entry.h"

#include <any>
#include <memory>
#include <span>
#include <vector>

namespace nephroid::ui {

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
