// SPDX-License-Identifier: Apache-2.0
// Named actions and their buttons. One table of them makes the menus, the shortcuts and the help.
#pragma once
#include "ui/state/context.h"

namespace nephroid::ui {

struct Action {
  std::string name;
  int shortcut;     ///< an ImGuiKeyChord; 0: none
  std::string help; ///< a sentence
  std::function<bool(const Context&)> enabled;
  std::function<void(const Context&)> run;
  std::function<std::string(const Context&)> why_not = nullptr; ///< why it is disabled, where a person may wonder
  std::function<void(const Context&)> let_go = nullptr;         ///< called when a held key is released
  std::function<bool(const Context&)> checked = nullptr;        ///< whether it is on; null: it cannot be on or off
  bool repeats = false;                                         ///< repeats while the keys are held
  bool ends_typing = false;                                     ///< what is being typed counts before it runs
  std::string menu = {};                                        ///< the menu that lists it
};

/// All actions: actions/table.cpp.
std::span<const Action> actions();
/// Throws failed where there is no action of this name.
const Action& action(const char* name);
/// The action's keys as text; empty where it has none.
const char* keys_of(const Action& action);
/// A button that runs an action; its tooltip has help, keys and, where it is disabled, the reason.
void action_button(const char* name, const Context& context);
void action_item(const Action& action, const Context& context);

} // namespace nephroid::ui
