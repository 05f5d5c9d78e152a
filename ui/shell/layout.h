// SPDX-License-Identifier: Apache-2.0
// Where the panels are, built with Dear ImGui's docking: the first of the table at the left, the others as tabs at the right. A layout is
// named after the panel that is in front of the tabs.
#pragma once
#include <string>

namespace nephroid::ui {

/// Throws bad_input naming the layouts there are. Empty means the default.
void check_layout(const std::string& name);
/// Docks every panel into the dock space of this id (an ImGuiID). Inside of a frame.
void build_layout(const std::string& name, unsigned dock_space, float width, float height);

} // namespace nephroid::ui
