// SPDX-License-Identifier: Apache-2.0
// A panel of the window: reads the workbench, draws with Dear ImGui, pushes commands. It needs no back end to be drawn.
#pragma once
#include "ui/state/commands.h"

namespace nephroid::ui {

class Workbench;

class Panel {
public:
  virtual ~Panel() = default;
  /// The title of its tab and its name in a layout.
  virtual const char* name() const = 0;
  /// Inside of the panel's window. What it throws becomes a message.
  virtual void draw(const Workbench& workbench, Commands& commands) = 0;
};

} // namespace nephroid::ui
