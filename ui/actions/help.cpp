// SPDX-License-Identifier: Apache-2.0
// The menu "Help".
#include "ui/actions/table.h"

namespace nephroid::ui {

std::vector<Action> help_actions()
{
  return {{"Help", "Mouse and keys", ImGuiKey_F1, false, "What the mouse and the keys do", always, push<command::ToggleHelp>}};
}

} // namespace nephroid::ui
