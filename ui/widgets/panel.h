// SPDX-License-Identifier: Apache-2.0
// A panel of the window: reads what it needs of its context, draws with Dear ImGui, pushes commands. It needs no back end to be drawn. A
// new one is a folder with its class, and a line in ui/shell/panels.cpp.
#pragma once
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

#include <imgui.h>

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
  /// What the item drawn last changes of the preset, from taking hold of it to letting go one gesture. Its place is noted as `widget`.
  template <class Change>
  void follow_item(const Context& context, Gestures& gestures, const std::string& widget, bool changed, const std::string& label,
                   Change change)
  {
    places_.note(widget);
    if (ImGui::IsItemActivated()) gestures.begin();
    if (changed) context.edit(label, change, gestures.number(), true);
    if (ImGui::IsItemDeactivated()) context.push(command::EndGesture{});
  }

  WidgetPlaces places_;
};

} // namespace nephroid::ui
