// SPDX-License-Identifier: Apache-2.0
// What a person can do by name, and buttons for it. The one table of them makes the menus, the shortcuts and the help.
#pragma once
#include "ui/state/context.h"

#include <span>

namespace nephroid::ui {

struct Action {
  std::string name;
  int shortcut;     ///< an ImGuiKeyChord, 0 for none
  std::string help; ///< a sentence
  std::function<bool(const Context&)> enabled;
  std::function<void(const Context&)> run;
  std::function<std::string(const Context&)> why_not =
      nullptr;                                          ///< where it is not enabled and a person may wonder: the reason
  std::function<void(const Context&)> let_go = nullptr; ///< of a key that is held: when it goes up again
  std::function<bool(const Context&)> checked = nullptr; ///< of what can be on or off: whether it is on
  bool repeats = false;                                  ///< while the keys are held
  std::string menu = {};                                 ///< the menu it is in
};

/// The table: actions/table.cpp.
std::span<const Action> actions();
/// By its name; throws failed where there is none.
const Action& action(const char* name);
/// Its keys, as text; empty where it has none.
const char* keys_of(const Action& action);
/// A button that runs an action; greyed where it is not enabled, its help and shortcut as a tooltip.
void action_button(const char* name, const Context& context);
/// The same as an entry of a menu.
void action_item(const Action& action, const Context& context);

} // namespace nephroid::ui
