// SPDX-License-Identifier: Apache-2.0
// A panel of the window: reads what it needs of its context, draws with Dear ImGui, pushes commands. It needs no back end to be drawn. A
// new one is a folder with its class, and a line in ui/shell/panels.cpp.
#pragma once
#include "ui/state/context.h"

namespace nephroid::ui {

class Panel {
public:
  virtual ~Panel() = default;
  /// Inside of the panel's window. What it throws becomes a message.
  virtual void draw(const Context& context) = 0;
};

} // namespace nephroid::ui
