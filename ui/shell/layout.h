// SPDX-License-Identifier: Apache-2.0
// Where the panels are: named layouts, built with Dear ImGui's docking.
#pragma once
#include <string>

namespace nephroid::ui {

/// Throws bad_input naming the layouts there are.
void check_layout(const std::string& name);
/// Docks every panel of the layout into the dock space of this id (an ImGuiID). Inside of a frame.
void build_layout(const std::string& name, unsigned dock_space, float width, float height);

} // namespace nephroid::ui
