// SPDX-License-Identifier: Apache-2.0
// The menu "Help".
#include "ui/actions/table.h"

namespace nephroid::ui {

std::vector<Action> help_actions()
{
  const char* menu = "Help";
  return {
      {menu, "Commands...", ctrl | shift | ImGuiKey_P, false, "Every action of the window and every preset, by typing some of its letters",
       always, ask<Question::command>},
      {menu, "Mouse and keys", ImGuiKey_F1, false, "What the mouse and the keys do", always, push<command::ToggleHelp>},
  };
}

} // namespace nephroid::ui
