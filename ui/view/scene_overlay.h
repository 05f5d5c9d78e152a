// SPDX-License-Identifier: Apache-2.0
// What the View draws of the scene over its picture: lights as small icons, the box about the selected object, the handles on what is
// selected. And what a click in the picture selects.
#pragma once
#include "ui/state/context.h"
#include "ui/view/gizmo.h"
#include "ui/view/placement.h"

namespace nephroid::ui {

class SceneOverlay {
public:
  /// Inside of the View's window, after the picture, which is of so many pixels. hovered: as Gizmo::draw has it.
  void draw(const Context& context, const Canvas& canvas, const std::array<int, 2>& picture, bool hovered);
  /// Whether a drag of the mouse is one of the handles.
  bool has_mouse() const { return gizmo_.has_mouse(); }
  /// Selects the light whose icon is there, else the object that the camera sees there, else nothing.
  void click(const Context& context, const Point& at) const;
  const Gizmo& gizmo() const { return gizmo_; }
  /// Where a light's icon was drawn last; for tests. Nothing where it is not in sight.
  std::optional<Point> icon(const Context& context, std::size_t light) const;

private:
  std::optional<Sight> sight_; ///< of the newest frame; nothing where there is nothing to select
  Gizmo gizmo_;
};

} // namespace nephroid::ui
