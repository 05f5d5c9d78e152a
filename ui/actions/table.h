// SPDX-License-Identifier: Apache-2.0
// The table of actions, a file a menu but for the small ones: menus, palette and the buttons of panels are made of it.
#pragma once
#include "ui/widgets/action.h"

#include <imgui.h>

namespace nephroid::ui {

std::vector<Action> add_actions();
std::vector<Action> select_actions();
std::vector<Action> animation_actions();
std::vector<Action> view_actions();
std::vector<Action> picture_actions();

using C = const Context&;

// What several menus ask.
inline bool always(C) { return true; }
inline bool has_preset(C c) { return c.preset() != nullptr; }
inline bool has_things(C c) { return c.preset() && has_scene(*c.preset()); }
inline std::string why_no_things(C c) { return c.preset() ? "this preset has no scene" : "no preset is open"; }
inline bool has_picture(C c) { return c.run.snapshot() != nullptr; }

inline Action repeating(Action action) {
  action.repeats = true;
  return action;
}
inline Action ending_typing(Action action) {
  action.ends_typing = true;
  return action;
}
/// What can be on or off.
inline Action switching(Action action, std::function<bool(C)> is_on) {
  action.checked = std::move(is_on);
  return action;
}

template <class Pushed>
void push(C c) {
  c.push(Pushed{});
}

template <Question question>
void ask(C c) {
  c.push(command::Ask{question});
}

inline constexpr int ctrl = ImGuiMod_Ctrl, shift = ImGuiMod_Shift;

} // namespace nephroid::ui
