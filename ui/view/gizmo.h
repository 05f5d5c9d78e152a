// SPDX-License-Identifier: Apache-2.0
// What the View draws of the scene over its picture, and what a click there selects. A drag of a handle edits the
// preset. The edit is computed in double precision from the start of the drag; ImGuizmo, which draws the handles, only
// says how far the drag went.
#pragma once
#include "ui/state/context.h"
#include "ui/view/gizmo_edits.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// ImGuizmo's coordinates. They are in single precision, so lengths are in distances from the camera, and places are
/// relative to the middle of the handles.
struct GizmoFrame {
  Pinhole pinhole;
  glm::dvec3 base{0}; ///< the frame's origin
  double unit = 1;    ///< the distance of base in front of the camera
};
glm::mat4 view_matrix(const GizmoFrame& frame);
/// The projection for a canvas, which the picture may fill in part or exceed.
glm::mat4 projection_matrix(const Pinhole& pinhole, const Canvas& canvas);

class Gizmo {
public:
  Gizmo();
  /// Called in the View's window, after the picture. hovered: the mouse is over the picture's canvas and nothing else.
  void draw(const Context& context, const Pinhole& pinhole, const Canvas& canvas, bool hovered);
  /// Called in a frame without handles: a drag ends.
  void rest(const Context& context);
  /// Whether a handle is being dragged, so that the mouse does nothing else.
  bool has_mouse() const { return drag_.has_value(); }
  /// For tests: the middle of the handles and the tips of the three arrows (or their counterparts for turning and
  /// scaling) where they were drawn last; nothing where there are none.
  const std::optional<std::array<Point, 4>>& places() const { return places_; }

private:
  struct Drag {
    preset::Preset start, newest; ///< newest: the last pushed
    Selection selection;
    GizmoTarget grip;
    GizmoFrame frame;
    Handles::Tool tool = Handles::Tool::move;
    bool own_axes = false;
    int handle = 0;        ///< ImGuizmo::MOVETYPE
    Point from{0, 0};      ///< where the drag began
    glm::mat4 matrix{1};   ///< the matrix that ImGuizmo continues from
    bool snaps = false;    ///< whether it snaps now
    std::string text = {}; ///< the drag so far, in words
    int shown = 0;         ///< the animation's frame that it began in
  };
  void end_drag(const Context& context);
  void take_back(const Context& context);
  void follow(const Context& context, const glm::mat4& matrix);
  std::string edit(preset::Preset& edited, const glm::mat4& matrix) const;
  void note_places(const GizmoFrame& frame, const glm::dmat3& axes);

  Gestures gestures_{"gizmo"};
  std::optional<Drag> drag_;
  std::optional<std::array<Point, 4>> places_;
};

/// Draws lights as small icons, the box about the selected object, and the handles.
class SceneOverlay {
public:
  /// Called in the View's window, after the picture, of this size in pixels. hovered: as for Gizmo::draw.
  void draw(const Context& context, const Canvas& canvas, const std::array<int, 2>& picture, bool hovered);
  bool has_mouse() const { return gizmo_.has_mouse(); }
  /// Selects the light whose icon is there, else the object that the camera sees there; else clears the selection.
  void click(const Context& context, const Point& at) const;
  const Gizmo& gizmo() const { return gizmo_; }
  /// For tests: where a light's icon was drawn last. Nothing where it is out of sight.
  std::optional<Point> icon(const Context& context, std::size_t light) const;

private:
  std::optional<Pinhole> pinhole_; ///< the newest frame's; nothing where there is nothing to select
  Gizmo gizmo_;
};

} // namespace nephroid::ui
