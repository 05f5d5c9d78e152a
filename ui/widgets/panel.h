// SPDX-License-Identifier: Apache-2.0
// A panel of the window: reads what it needs of its context, draws with Dear ImGui, pushes commands. It needs no back end to be drawn. A
// new one is a folder with its class, and a line in ui/shell/panels.cpp.
#pragma once
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

#include <array>
#include <optional>
#include <string>

namespace nephroid::ui {

class Panel {
public:
  virtual ~Panel() = default;
  /// Inside of the panel's window. What it throws becomes a message.
  virtual void draw(const Context& context) = 0;
  /// For tests: the middle of a widget on the screen, as the panel calls it; nothing where it was not drawn last.
  std::optional<std::array<double, 2>> place_of(const std::string& widget) const { return places_.of(widget); }

protected:
  WidgetPlaces places_;
};

} // namespace nephroid::ui
