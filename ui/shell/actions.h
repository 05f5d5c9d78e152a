// SPDX-License-Identifier: Apache-2.0
// The one table of what a person can do by name: it makes the menus, the shortcuts and the help.
#pragma once
#include "ui/state/commands.h"

#include <span>
#include <string>

namespace nephroid::ui {

class Workbench;

struct Action {
  const char* menu; ///< the menu it is in
  const char* name;
  int shortcut;     ///< an ImGuiKeyChord, 0 for none
  bool repeats;     ///< while the keys are held
  const char* help; ///< a sentence
  bool (*enabled)(const Workbench&);
  void (*run)(const Workbench&, Commands&);
  std::string (*why_not)(const Workbench&) = nullptr;    ///< where it is not enabled and a person may wonder: the reason
  void (*let_go)(const Workbench&, Commands&) = nullptr; ///< of a key that is held: when it goes up again
};

std::span<const Action> actions();
/// By its name; throws failed where there is none.
const Action& action(const char* name);
/// A button that runs an action; greyed where it is not enabled, its help and shortcut as a tooltip.
void action_button(const char* name, const Workbench& workbench, Commands& commands);
/// The same as an entry of a menu.
void action_item(const char* name, const Workbench& workbench, Commands& commands);
/// The menus of the main menu bar, in the table's order.
void draw_menus(const Workbench& workbench, Commands& commands);
/// Runs the actions whose keys were pressed; says why where one is not enabled and has a reason. Keys that a text field or a dialog wants
/// are left to it.
void run_shortcuts(const Workbench& workbench, Commands& commands);

} // namespace nephroid::ui
