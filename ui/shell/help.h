// SPDX-License-Identifier: Apache-2.0
// The overlay that says what the mouse and the keys do.
#pragma once
#include "ui/state/commands.h"

namespace nephroid::ui {

class Workbench;

void draw_help(const Workbench& workbench, Commands& commands);

} // namespace nephroid::ui
