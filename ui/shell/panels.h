// SPDX-License-Identifier: Apache-2.0
// The table of panels, a line each; and where they are: as a preset's engine begins with them, and as a person left
// them, in Dear ImGui's format.
#pragma once
#include "preset/preset.h"
#include "run/prepare.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

/// In the order of their tabs; the first is the picture.
std::span<const PanelEntry> panel_table();
/// All but the picture can be closed.
bool can_close(const PanelEntry& entry);
/// Whether a person has not closed it for the engine in hand.
bool is_open(const PanelEntry& entry, const Context& context);
/// Whether it was drawn in the last frame: a tab behind another is open and not seen.
bool is_seen(const PanelEntry& entry);
bool serves(const PanelEntry& entry, const preset::Preset& preset);
/// What the panels of the preset's engine keep of a scene (TakeFacts of state/device_runs.h).
SceneFacts take_facts(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded);

/// Throws bad_input naming the layouts there are: each is named after the panel that is in front of the tabs. Empty is
/// the engine's own.
void check_layout(const std::string& name);

/// The tabs that are in front, each as ImGuiWindow::TabId.
using FrontTabs = std::vector<unsigned>;
FrontTabs panels_in_sight();
/// Docks the picture at the left of the dock space of this id (an ImGuiID) and the other panels as tabs at its right.
/// Inside of a frame, before the panels.
FrontTabs begin_layout(const std::string& name, const preset::Preset& preset, unsigned dock_space, float width,
                       float height);
/// As layout_now() had it; panels that it does not know are tabs beside the first one. Inside of a frame, before the
/// dock space.
FrontTabs restore_layout(const std::string& ini);
/// In the frames after either: tabs that come up may go before those that shall be in front.
void bring_to_front(const FrontTabs& tabs);
/// Where every panel is, as Dear ImGui writes it.
std::string layout_now();

} // namespace nephroid::ui
