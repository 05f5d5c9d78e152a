// SPDX-License-Identifier: Apache-2.0
// The table of actions, a file a menu but for the small ones. shell/menus.cpp and the buttons of panels are made of it. A new action is an
// entry in one of these files.
#pragma once
#include "ui/widgets/action.h"

#include <imgui.h>

#include <vector>

namespace nephroid::ui {

std::vector<Action> file_actions();
std::vector<Action> edit_actions();
std::vector<Action> select_actions();
std::vector<Action> run_actions();
std::vector<Action> view_actions();
std::vector<Action> window_actions();

using C = const Context&;

// What several menus ask.
inline bool always(C) { return true; }
inline bool has_preset(C c) { return c.preset() != nullptr; }
inline bool has_picture(C c) { return c.run.snapshot() != nullptr; }

/// Pushes a command without arguments.
template <class Pushed>
void push(C c)
{
  c.push(Pushed{});
}

template <Question question>
void ask(C c)
{
  c.push(command::Ask{question});
}

inline constexpr int ctrl = ImGuiMod_Ctrl, shift = ImGuiMod_Shift;

} // namespace nephroid::ui
