// SPDX-License-Identifier: Apache-2.0
#include "ui/actions/table.h"

namespace nephroid::ui {

std::span<const Action> actions()
{
  static const std::vector<Action> table = [] {
    std::vector<Action> all;
    for (const auto& menu : {file_actions(), edit_actions(), run_actions(), view_actions(), window_actions(), help_actions()})
      all.insert(all.end(), menu.begin(), menu.end());
    return all;
  }();
  return table;
}

} // namespace nephroid::ui
