// SPDX-License-Identifier: Apache-2.0
// What a person can do by name, and buttons for it. The one table of them makes the menus, the shortcuts and the help.
#pragma once
#include "ui/state/context.h"

#include <span>
#include <string>

namespace nephroid::ui {

struct Action {
  const char* menu; ///< the menu it is in
  const char* name;
  int shortcut;     ///< an ImGuiKeyChord, 0 for none
  bool repeats;     ///< while the keys are held
  const char* help; ///< a sentence
  bool (*enabled)(const Context&);
  void (*run)(const Context&);
  std::string (*why_not)(const Context&) = nullptr; ///< where it is not enabled and a person may wonder: the reason
  void (*let_go)(const Context&) = nullptr;         ///< of a key that is held: when it goes up again
};

/// The table: shell/actions.cpp.
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
