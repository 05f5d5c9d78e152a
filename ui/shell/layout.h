// SPDX-License-Identifier: Apache-2.0
// Where panels are: the layout that a preset's engine begins with, docking panels as a layout says, and reading back what a person made of
// it.
#pragma once
#include "ui/state/settings.h"

#include <string>

namespace nephroid::ui {

/// Throws bad_input naming the layouts there are: each is named after the panel that is in front of the tabs. Empty is the engine's own.
void check_layout(const std::string& name);
/// The picture at the left, the other panels as tabs at the right of a window of this width. engine: of the preset; empty: none is open.
Layout starting_layout(const std::string& name, const std::string& engine, float width);
/// Docks every panel that does not float into the dock space of this id (an ImGuiID); those that the layout does not have, as new ones,
/// become tabs beside the first that it has. Inside of a frame.
void apply_layout(const Layout& layout, unsigned dock_space, float width, float height);
/// Has the layout's tabs in front. In the frames after apply_layout: tabs that come up may go before them.
void bring_to_front(const Dock& dock);
/// Where a floating panel's window is that begins next.
void place_next(const Floating& floating);
/// What is docked into the dock space now, and what floats.
Layout layout_now(unsigned dock_space);

} // namespace nephroid::ui
