// SPDX-License-Identifier: Apache-2.0
// The panel "Parameters": every field of the preset, drawn and edited by its description (preset/outline.h), so that a
// new field is here by itself. What is impossible is said at its field and waits (draft.h), while the run goes on as it
// was.
#pragma once
#include "ui/parameters/rows.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class ParametersPanel : public Panel {
public:
  static constexpr const char* title = "Parameters";
  void draw(const Context& context) override;

  /// For tests: what waits, and the middle of a widget on the screen: "/scene/camera/fov_deg" is a field's own,
  /// "/scene/lights:add",
  /// "/white:reset" and so on are buttons, "search" is the box at the top. Nothing where it is not drawn.
  const Draft& draft() const { return form_.draft; }

private:
  void follow_run(const Context& context);
  void draw_top();

  Form form_{title, places_};
  FieldRows rows_{form_};
  Selection revealed_; ///< what was selected when its fields were brought into sight last
};

} // namespace nephroid::ui
