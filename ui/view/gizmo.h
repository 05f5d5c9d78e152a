// SPDX-License-Identifier: Apache-2.0
// The handles on what is selected: ImGuizmo drawn over the picture with the camera's own projection, and what a drag of
// one of them does to the preset. What is edited is worked out in double precision from the start of the drag; ImGuizmo
// only says how far it went. And all that the View draws of the scene over its picture, and what a click there selects.
#pragma once
#include "ui/state/context.h"
#include "ui/view/gizmo_edits.h"
#include "ui/view/pinhole.h"
#include "ui/view/placement.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// What ImGuizmo calculates in: single precision, so lengths are in distances from the camera, and places from the
/// middle of the handles.
struct GizmoFrame {
  Pinhole pinhole;
  glm::dvec3 base{0}; ///< the frame's origin
  double unit = 1;    ///< how far that is in front of the camera
};
glm::mat4 view_matrix(const GizmoFrame& frame);
/// Of a canvas that the picture may fill in part, or be larger than.
glm::mat4 projection_matrix(const Pinhole& pinhole, const Canvas& canvas);

class Gizmo {
public:
  Gizmo();
  /// Inside of the View's window, after the picture. hovered: the mouse is over the picture's canvas and nothing else.
  void draw(const Context& context, const Pinhole& pinhole, const Canvas& canvas, bool hovered);
  /// In a frame where nothing can be taken hold of: a drag ends.
  void rest(const Context& context);
  /// Whether a handle is being dragged, so that the mouse means nothing else.
  bool has_mouse() const { return drag_.has_value(); }
  /// For tests: the middle of the handles and the tips of the three arrows, or of what they are when turning and
  /// scaling, where they were drawn last; nothing where there are none.
  const std::optional<std::array<Point, 4>>& places() const { return places_; }

private:
  struct Drag {
    preset::Preset start, newest; ///< newest: what was pushed last
    Selection selection;
    GizmoTarget grip;
    GizmoFrame frame;
    Handles::Tool tool = Handles::Tool::move;
    bool own_axes = false;
    int handle = 0;        ///< ImGuizmo::MOVETYPE
    Point from{0, 0};      ///< where the mouse took hold
    glm::mat4 matrix{1};   ///< as ImGuizmo goes on from
    bool snaps = false;    ///< now
    std::string text = {}; ///< what was done so far
  };
  void end_drag(const Context& context);
  void follow(const Context& context, const glm::mat4& matrix);
  std::string edit(preset::Preset& edited, const glm::mat4& matrix) const;
  void note_places(const GizmoFrame& frame, const glm::dmat3& axes);

  Gestures gestures_{"gizmo"};
  std::optional<Drag> drag_;
  std::optional<std::array<Point, 4>> places_;
};

/// Lights as small icons, the box about the selected object, the handles on what is selected.
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
  std::optional<Pinhole> pinhole_; ///< of the newest frame; nothing where there is nothing to select
  Gizmo gizmo_;
};

} // namespace nephroid::ui
