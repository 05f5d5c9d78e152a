// SPDX-License-Identifier: Apache-2.0
#include "ui/view/gizmo.h"

#include "ui/view/bars.h"

#include <imgui_internal.h>

#include <ImGuizmo.h> // needs imgui.h before it

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nephroid::ui {
namespace {

using Tool = Handles::Tool;

constexpr float handle_em = 6; ///< an arrow's length in font sizes
constexpr float farthest = 50; ///< where a drag ends, in distances from the camera

/// Releases the handle; ImGuizmo has one state for the whole program.
void let_go() {
  ImGuizmo::Enable(false);
  ImGuizmo::Enable(true);
}

/// The counter-clockwise angle from one orientation to another about an axis.
double degrees_about(const glm::dvec3& axis, const glm::mat4& now, const glm::dmat3& start) {
  glm::dmat3 turned(now);
  for (int i = 0; i < 3; ++i) turned[i] = glm::normalize(turned[i]);
  const glm::dmat3 r = turned * glm::transpose(start);
  const glm::dvec3 sine(0.5 * (r[1][2] - r[2][1]), 0.5 * (r[2][0] - r[0][2]), 0.5 * (r[0][1] - r[1][0]));
  return glm::degrees(std::atan2(glm::dot(axis, sine), 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1)));
}

/// The factors of a scaling: the mouse's distance from the middle of the handles, along an axis as it lies in the
/// picture, over that at the start. For all axes at once a pixel to the right is a hundredth. (ImGuizmo intersects the
/// mouse's ray with a plane, which fails where the plane is seen from its edge.)
glm::dvec3 factors_of(const GizmoFrame& frame, const glm::dmat3& axes, int handle, const Point& from, const Point& now,
                      double step) {
  constexpr double smallest = 0.01;
  const auto stepped = [&](double factor) {
    return std::max(step > 0 ? step * std::round(factor / step) : factor, smallest);
  };
  if (handle == ImGuizmo::MT_SCALE_XYZ) return glm::dvec3(stepped(1 + (now[0] - from[0]) / (100 * scale())));
  const int axis = handle - ImGuizmo::MT_SCALE_X;
  const auto middle = frame.pinhole.to_screen(frame.base),
             beside = frame.pinhole.to_screen(frame.base + 0.01 * frame.unit * axes[axis]);
  glm::dvec3 factors(1);
  if (!middle || !beside) return factors;
  const auto along = [&](const Point& p) {
    return ((*beside)[0] - (*middle)[0]) * (p[0] - (*middle)[0]) +
           ((*beside)[1] - (*middle)[1]) * (p[1] - (*middle)[1]);
  };
  if (const double start = along(from); start != 0) factors[axis] = stepped(along(now) / start);
  return factors;
}

ImGuizmo::OPERATION operation(Tool tool, const GizmoTarget& grip) {
  if (tool == Tool::move) return ImGuizmo::TRANSLATE;
  if (tool == Tool::turn) return ImGuizmo::ROTATE;
  constexpr ImGuizmo::OPERATION along[] = {ImGuizmo::SCALE_X, ImGuizmo::SCALE_Y, ImGuizmo::SCALE_Z};
  int all = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (grip.scales[i]) all |= along[i];
  return static_cast<ImGuizmo::OPERATION>(all);
}

/// Numbers are drawn here, because ImGuizmo's would be in the frame's units.
void prepare(const Canvas& canvas) {
  ImGuizmo::BeginFrame();
  ImGuizmo::SetDrawlist();
  ImGuizmo::SetOrthographic(false);
  ImGuizmo::AllowAxisFlip(false);
  const auto [x, y] = canvas.corner;
  const auto [width, height] = canvas.size;
  ImGuizmo::SetRect(static_cast<float>(x), static_cast<float>(y), static_cast<float>(width),
                    static_cast<float>(height));
  ImGuizmo::SetGizmoSizeClipSpace(2 * handle_em * em() / static_cast<float>(std::max(width, height)));
  // The mouse may leave the View's window while it drags.
  ImGuizmo::SetAlternativeWindow(ImGuizmo::IsUsingAny() ? ImGui::GetCurrentContext()->HoveredWindow : nullptr);
  ImGuizmo::Style& style = ImGuizmo::GetStyle();
  const float size = scale();
  style = {};
  style.TranslationLineThickness = style.ScaleLineThickness = style.RotationOuterLineThickness = 3 * size;
  style.RotationLineThickness = 2.5f * size;
  style.TranslationLineArrowSize = style.ScaleLineCircleSize = style.CenterCircleSize = 6 * size;
  style.Colors[ImGuizmo::DIRECTION_X] = {0.90f, 0.28f, 0.25f, 1};
  style.Colors[ImGuizmo::DIRECTION_Y] = {0.38f, 0.75f, 0.25f, 1};
  style.Colors[ImGuizmo::DIRECTION_Z] = {0.30f, 0.52f, 0.95f, 1};
  style.Colors[ImGuizmo::SELECTION] = {1.00f, 0.80f, 0.20f, 1};
  for (const int text : {ImGuizmo::TEXT, ImGuizmo::TEXT_SHADOW}) style.Colors[text] = {0, 0, 0, 0};
}

const char* verb(Tool tool) { return tool == Tool::move ? "move" : tool == Tool::turn ? "turn" : "scale"; }

constexpr ImU32 lamp = IM_COL32(255, 214, 102, 255), marked = IM_COL32(255, 150, 50, 255);
constexpr float icon_radius = 6, grab_radius = 10; ///< pixels at scale 1

/// Draws the part of a line of the scene in front of the camera, with a dark outline to be visible on any colour.
void draw_line(const Pinhole& pinhole, glm::dvec3 a, glm::dvec3 b, ImU32 colour) {
  const double from = pinhole.depth(a), to = pinhole.depth(b), nearest = 1e-3 * std::max(std::abs(from), std::abs(to));
  if (!(std::max(from, to) > nearest)) return;
  if (from < nearest) a += (nearest - from) / (to - from) * (b - a);
  if (to < nearest) b += (nearest - to) / (from - to) * (a - b);
  const auto start = pinhole.to_screen(a), end = pinhole.to_screen(b);
  if (!start || !end) return;
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddLine(vec(*start), vec(*end), colour::outline, 3 * scale());
  draw_list->AddLine(vec(*start), vec(*end), colour, 1.4f * scale());
}

/// Draws a parallelepiped, given by its middle and three half edges.
void draw_box(const Pinhole& pinhole, const glm::dvec3& middle, const glm::dmat3& half, ImU32 colour) {
  const auto corner = [&](unsigned bits) {
    glm::dvec3 p = middle;
    for (int axis = 0; axis < 3; ++axis) p += (bits >> axis & 1 ? 1.0 : -1.0) * half[axis];
    return p;
  };
  for (unsigned bits = 0; bits < 8; ++bits)
    for (unsigned axis = 0; axis < 3; ++axis)
      if (!(bits >> axis & 1)) draw_line(pinhole, corner(bits), corner(bits | 1U << axis), colour);
}

void draw_object_box(const Context& context, const Pinhole& pinhole, std::size_t index) {
  const auto box = local_box(context.run.scene_facts().view.get(), *context.preset(), index);
  if (!box) return;
  const Affine placed(context.preset()->scene.objects[index].transform);
  const glm::dvec3 half = 0.5 * (box->high - box->low), middle = placed.linear * (box->low + half) + placed.offset;
  draw_box(pinhole, middle, {half.x * placed.linear[0], half.y * placed.linear[1], half.z * placed.linear[2]}, marked);
}

/// Draws an area light's rectangle, other lights' direction, and a disc at the light's place.
void draw_light(const Context& context, const Pinhole& pinhole, std::size_t index, bool selected) {
  const preset::Preset& preset = *context.preset();
  const preset::Light& light = preset.scene.lights[index];
  const auto held = grip_of(preset, {Selection::Kind::light, index}, nullptr);
  if (!held) return; // a mesh is where its object is
  const GizmoTarget& grip = *held;
  const auto at = pinhole.to_screen(grip.at);
  if (!at) return;
  const ImU32 colour = selected ? marked : lamp;
  const double scene_em = 2 * pinhole.depth(grip.at) * pinhole.tan_x / pinhole.size[0] * em();
  if (preset::has(light.type, LIGHT_HAS_EDGES))
    draw_box(pinhole, grip.at, {0.5 * light.size[0] * grip.axes[0], 0.5 * light.size[1] * grip.axes[1], glm::dvec3(0)},
             colour);
  if (preset::is_directed(light)) draw_line(pinhole, grip.at, grip.at + 2.5 * scene_em * grip.axes[2], colour);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  const float radius = icon_radius * scale();
  draw_list->AddCircleFilled(vec(*at), radius + 2 * scale(), colour::outline);
  draw_list->AddCircleFilled(vec(*at), radius, colour);
  draw_list->AddCircleFilled(vec(*at), 0.4f * radius, colour::outline);
}

} // namespace

glm::mat4 view_matrix(const GizmoFrame& frame) {
  const glm::dvec3 eye = (frame.pinhole.position - frame.base) / frame.unit;
  return glm::lookAt(eye, eye + frame.pinhole.forward, frame.pinhole.up);
}

glm::mat4 projection_matrix(const Pinhole& pinhole, const Canvas& canvas) {
  constexpr double near = 0.05, far = 10; // in the frame's units; nothing is clipped there
  // The canvas' edges in the picture, from -1 to 1, with y down on the screen.
  const auto edge = [&](std::size_t i, double part) {
    return 2 * (canvas.corner[i] + part * canvas.size[i] - pinhole.corner[i]) / pinhole.size[i] - 1;
  };
  const double x = near * pinhole.tan_x, y = -near * pinhole.tan_y;
  return glm::frustum(x * edge(0, 0), x * edge(0, 1), y * edge(1, 1), y * edge(1, 0), near, far);
}

Gizmo::Gizmo() { let_go(); }

void Gizmo::draw(const Context& context, const Pinhole& pinhole, const Canvas& canvas, bool hovered) {
  prepare(canvas);
  places_.reset();
  const Selection selection = context.selection();
  if (drag_ && (drag_->selection != selection || !context.view_state.handles.shown)) end_drag(context);
  const auto grip = grip_of(*context.preset(), selection, context.run.scene_facts().view.get());
  if (!grip || !context.view_state.handles.shown) return;
  const Handles& handles = context.view_state.handles;
  const GizmoFrame frame = drag_ ? drag_->frame : GizmoFrame{pinhole, grip->at, pinhole.depth(grip->at)};
  if (!(frame.unit > 0)) return; // it is behind the camera
  const Tool tool = drag_ ? drag_->tool : usable_tool(*grip, handles.tool);
  const bool own_axes = drag_ ? drag_->own_axes : handles.own_axes || tool == Tool::scale;
  glm::mat4 matrix = drag_ ? drag_->matrix : glm::mat4(glm::mat3(grip->axes));
  const glm::mat4 view = view_matrix(frame), projection = projection_matrix(frame.pinhole, canvas);
  const bool snaps = handles.snap != ImGui::GetIO().KeyCtrl;
  const glm::vec3 steps(tool == Tool::move   ? snap_step(frame.unit) / frame.unit
                        : tool == Tool::turn ? snap_deg
                                             : snap_factor);
  // ImGuizmo ignores the mouse over an item of Dear ImGui, and the picture is one.
  ImGuiContext& imgui = *ImGui::GetCurrentContext();
  const std::array items{imgui.HoveredId, imgui.HoveredIdPreviousFrame, imgui.ActiveId};
  if (hovered || drag_) imgui.HoveredId = imgui.HoveredIdPreviousFrame = imgui.ActiveId = 0;
  ImGuizmo::Manipulate(glm::value_ptr(view), glm::value_ptr(projection), operation(tool, *grip),
                       own_axes ? ImGuizmo::LOCAL : ImGuizmo::WORLD, glm::value_ptr(matrix), nullptr,
                       snaps ? glm::value_ptr(steps) : nullptr);
  std::tie(imgui.HoveredId, imgui.HoveredIdPreviousFrame, imgui.ActiveId) = std::tie(items[0], items[1], items[2]);
  note_places(frame, own_axes ? grip->axes : glm::dmat3(1));
  if (!drag_ && ImGuizmo::IsUsing()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    drag_ = Drag{
        *context.preset(), *context.preset(), selection, *grip, frame, tool, own_axes, ImGuizmo::GetActiveHandleType(),
        {mouse.x, mouse.y}};
    drag_->matrix = matrix;
    drag_->shown = context.edits->frame();
    context.push(command::Play{false});
    gestures_.begin();
  }
  if (!drag_) return;
  drag_->snaps = snaps;
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) return take_back(context);
  follow(context, matrix);
  if (!drag_) return;
  const double beside = 0.6 * em();
  if (!drag_->text.empty()) draw_overlay(vec({(*places_)[0][0] + beside, (*places_)[0][1] + beside}), drag_->text);
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) end_drag(context);
}

void Gizmo::rest(const Context& context) {
  places_.reset();
  if (drag_) end_drag(context);
}

void Gizmo::end_drag(const Context& context) {
  if (ImGuizmo::IsUsingAny()) let_go();
  drag_.reset();
  context.push(command::EndGesture{});
}

void Gizmo::take_back(const Context& context) {
  const UndoStack::State& edits = context.edits->state();
  const bool is_newest = edits.entries[edits.index].gesture == gestures_.number(); // nothing may have moved
  end_drag(context);
  if (is_newest) context.push(command::Undo{});
}

void Gizmo::follow(const Context& context, const glm::mat4& matrix) {
  if (drag_->shown != context.edits->frame()) return end_drag(context); // its start is of another frame
  // Near the horizon of a plane a pixel can be any length, and beyond it there is no point.
  if (drag_->tool != Tool::scale) {
    const std::span values(glm::value_ptr(matrix), 16);
    if (!std::ranges::all_of(values, [](float value) { return std::abs(value) < farthest; })) return;
    drag_->matrix = matrix;
  }
  preset::Preset edited = drag_->start;
  std::string text = edit(edited, matrix);
  if (edited.scene == drag_->newest.scene || !make_pinhole(edited.scene.camera, {}, {1, 1})) return;
  drag_->newest = edited;
  edited.animation = context.preset()->animation; // has a key of this drag
  drag_->text = std::move(text);
  context.push(command::Edit{fmt::format("{} {}", verb(drag_->tool), name_of(edited, drag_->selection)),
                             std::move(edited), gestures_.number(), true});
}

/// Changes the preset of the drag's start; returns the change in words.
std::string Gizmo::edit(preset::Preset& edited, const glm::mat4& matrix) const {
  const Drag& d = *drag_;
  switch (d.tool) {
  case Tool::move: {
    const glm::dvec3 by = d.frame.unit * glm::dvec3(matrix[3]);
    const int decimals = decimals_for(d.frame.unit);
    move(edited, d.selection, by, decimals);
    const int shown = std::max(0, decimals - 1);
    return fmt::format("{:+.{}f}, {:+.{}f}, {:+.{}f} {}", by.x, shown, by.y, shown, by.z, shown, unit_word(edited));
  }
  case Tool::turn: {
    const int which = d.handle - ImGuizmo::MT_ROTATE_X;
    const glm::dvec3 axis = which == 3   ? -d.frame.pinhole.forward
                            : d.own_axes ? d.grip.axes[which]
                                         : glm::dmat3(1)[which];
    const double degrees = std::round(10 * degrees_about(axis, matrix, d.grip.axes)) / 10;
    turn(edited, d.selection, d.grip, axis, degrees);
    return fmt::format("{:+.1f} degrees", degrees);
  }
  case Tool::scale: break;
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec3 factors =
      factors_of(d.frame, d.grip.axes, d.handle, d.from, {mouse.x, mouse.y}, d.snaps ? snap_factor : 0);
  stretch(edited, d.selection, d.grip, factors);
  return fmt::format("times {:.3f}, {:.3f}, {:.3f}", factors.x, factors.y, factors.z);
}

void Gizmo::note_places(const GizmoFrame& frame, const glm::dmat3& axes) {
  const glm::dvec3 middle = drag_ ? frame.base + frame.unit * glm::dvec3(drag_->matrix[3]) : frame.base;
  const double pixel = 2 * frame.unit * frame.pinhole.tan_x / frame.pinhole.size[0];
  const double length = handle_em * em() * pixel;
  std::array<Point, 4> places{};
  for (int i = 0; i < 4; ++i)
    places[static_cast<std::size_t>(i)] =
        frame.pinhole.to_screen(i == 0 ? middle : middle + length * axes[i - 1]).value_or(Point{-1e9, -1e9});
  places_ = places;
}

std::optional<Point> SceneOverlay::icon(const Context& context, std::size_t light) const {
  const auto grip = pinhole_ ? grip_of(*context.preset(), {Selection::Kind::light, light}, nullptr) : std::nullopt;
  return grip ? pinhole_->to_screen(grip->at) : std::nullopt;
}

void SceneOverlay::draw(const Context& context, const Canvas& canvas, const std::array<int, 2>& picture, bool hovered) {
  const preset::Scene& scene = context.preset()->scene;
  pinhole_.reset();
  if (has_scene(*context.preset()))
    pinhole_ = make_pinhole(scene.camera, place(context.view_state.view_settings, canvas, picture), picture);
  const Selection selection = context.selection();
  const Comparison& comparison = context.comparing.comparison();
  const bool other_picture = comparison.flip || comparison.shown != 0; // nothing covers what is compared
  if (pinhole_ && context.view_state.handles.shown && !other_picture) {
    if (selection.kind == Selection::Kind::object) draw_object_box(context, *pinhole_, selection.index);
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      draw_light(context, *pinhole_, i, selection == Selection{Selection::Kind::light, i});
  }
  if (pinhole_ && !other_picture)
    gizmo_.draw(context, *pinhole_, canvas, hovered);
  else
    gizmo_.rest(context);
}

void SceneOverlay::click(const Context& context, const Point& at) const {
  if (!pinhole_ || !context.view_state.handles.shown) return;
  Selection selection;
  double nearest = grab_radius * scale();
  for (std::size_t i = 0; i < context.preset()->scene.lights.size(); ++i) {
    const auto place = icon(context, i);
    const double distance = place ? std::hypot((*place)[0] - at[0], (*place)[1] - at[1]) : nearest;
    if (distance >= nearest) continue;
    nearest = distance;
    selection = {Selection::Kind::light, i};
  }
  if (selection.kind == Selection::Kind::nothing) {
    const auto seen = context.run.scene_facts().view;
    if (!seen) return; // no run of the preset was ready yet, so the objects are unknown
    const Ray ray = pinhole_->ray(at);
    const bool inside = at[0] >= pinhole_->corner[0] && at[1] >= pinhole_->corner[1] &&
                        at[0] < pinhole_->corner[0] + pinhole_->size[0] &&
                        at[1] < pinhole_->corner[1] + pinhole_->size[1];
    if (const auto object = inside ? object_at(*seen, *context.preset(), ray) : std::nullopt)
      selection = {Selection::Kind::object, *object};
  }
  if (selection != context.selection()) context.push(command::Select{selection});
}

} // namespace nephroid::ui
