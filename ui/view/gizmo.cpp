// SPDX-License-Identifier: Apache-2.0
#include "ui/view/gizmo.h"

#include "ui/widgets/theme.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <ImGuizmo.h> // needs imgui.h before it

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::ui {
namespace {

using Tool = Handles::Tool;

constexpr float handle_em = 6; ///< the length of an arrow, in font sizes
constexpr float farthest = 50; ///< a drag ends there, in distances from the camera

/// While ImGuizmo looks at the mouse: it takes hold of nothing where an item of Dear ImGui is under the mouse, and the picture is one.
class NothingHovered {
public:
  NothingHovered()
      : hovered_(std::exchange(imgui_.HoveredId, 0)), before_(std::exchange(imgui_.HoveredIdPreviousFrame, 0)),
        active_(std::exchange(imgui_.ActiveId, 0))
  {
  }
  ~NothingHovered()
  {
    imgui_.HoveredId = hovered_;
    imgui_.HoveredIdPreviousFrame = before_;
    imgui_.ActiveId = active_;
  }
  NothingHovered(const NothingHovered&) = delete;

private:
  ImGuiContext& imgui_ = *ImGui::GetCurrentContext();
  ImGuiID hovered_, before_, active_;
};

/// ImGuizmo's state is one for the program: nothing is held any more.
void let_go()
{
  ImGuizmo::Enable(false);
  ImGuizmo::Enable(true);
}

Matrix16 placed(const glm::dmat3& axes)
{
  Matrix16 m{};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      m[4 * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)] = static_cast<float>(axes[column][row]);
  m[15] = 1;
  return m;
}

glm::dvec3 column(const Matrix16& m, std::size_t i) { return {m[4 * i], m[4 * i + 1], m[4 * i + 2]}; }

/// How far one orientation is turned from another about an axis, counter-clockwise.
double degrees_about(const glm::dvec3& axis, const Matrix16& now, const glm::dmat3& start)
{
  glm::dmat3 turned;
  for (int i = 0; i < 3; ++i) turned[i] = glm::normalize(column(now, static_cast<std::size_t>(i)));
  const glm::dmat3 r = turned * glm::transpose(start);
  const glm::dvec3 sine(0.5 * (r[1][2] - r[2][1]), 0.5 * (r[2][0] - r[0][2]), 0.5 * (r[0][1] - r[1][0]));
  return glm::degrees(std::atan2(glm::dot(axis, sine), 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1)));
}

/// How many times as far from the middle of the handles the mouse is as where it took hold, along an axis as it lies in the picture; for
/// all axes at once: a pixel to the right is a hundredth. (ImGuizmo asks where the mouse meets a plane, and there is no such place where
/// that is seen from its edge.)
glm::dvec3 factors_of(const GizmoFrame& frame, const glm::dmat3& axes, int handle, const Point& from, const Point& now, double step)
{
  constexpr double smallest = 0.01;
  const auto stepped = [&](double factor) { return std::max(step > 0 ? step * std::round(factor / step) : factor, smallest); };
  if (handle == ImGuizmo::MT_SCALE_XYZ) return glm::dvec3(stepped(1 + (now[0] - from[0]) / (100 * scale())));
  const int axis = handle - ImGuizmo::MT_SCALE_X;
  const auto middle = frame.sight.to_screen(frame.base), beside = frame.sight.to_screen(frame.base + 0.01 * frame.unit * axes[axis]);
  glm::dvec3 factors(1);
  if (!middle || !beside) return factors;
  const auto along = [&](const Point& p) {
    return ((*beside)[0] - (*middle)[0]) * (p[0] - (*middle)[0]) + ((*beside)[1] - (*middle)[1]) * (p[1] - (*middle)[1]);
  };
  if (const double start = along(from); start != 0) factors[axis] = stepped(along(now) / start);
  return factors;
}

ImGuizmo::OPERATION operation(Tool tool, const Grip& grip)
{
  if (tool == Tool::move) return ImGuizmo::TRANSLATE;
  if (tool == Tool::turn) return ImGuizmo::ROTATE;
  constexpr ImGuizmo::OPERATION along[] = {ImGuizmo::SCALE_X, ImGuizmo::SCALE_Y, ImGuizmo::SCALE_Z};
  int all = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (grip.scales[i]) all |= along[i];
  return static_cast<ImGuizmo::OPERATION>(all);
}

std::array<float, 3> snap_steps(Tool tool, double unit)
{
  const double step = tool == Tool::move ? snap_step(unit) / unit : tool == Tool::turn ? snap_deg : snap_factor;
  const auto edge = static_cast<float>(step);
  return {edge, edge, edge};
}

/// For the frame. Numbers are drawn here: ImGuizmo's would be in the frame's units.
void prepare(const Canvas& canvas)
{
  ImGuizmo::BeginFrame();
  ImGuizmo::SetDrawlist();
  ImGuizmo::SetOrthographic(false);
  ImGuizmo::AllowAxisFlip(false);
  const auto [x, y] = canvas.corner;
  const auto [width, height] = canvas.size;
  ImGuizmo::SetRect(static_cast<float>(x), static_cast<float>(y), static_cast<float>(width), static_cast<float>(height));
  ImGuizmo::SetGizmoSizeClipSpace(2 * handle_em * ImGui::GetFontSize() / static_cast<float>(std::max(width, height)));
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

void draw_text_at(const Point& at, const std::string& text)
{
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize(), pad = 0.3f * em;
  const ImVec2 corner{static_cast<float>(at[0]) + em, static_cast<float>(at[1]) + em}, extent = ImGui::CalcTextSize(text.c_str());
  draw_list->AddRectFilled({corner.x - pad, corner.y - pad}, {corner.x + extent.x + pad, corner.y + extent.y + pad}, colour::overlay, pad);
  draw_list->AddText(corner, colour::on_dark, text.c_str());
}

const char* verb(Tool tool) { return tool == Tool::move ? "move" : tool == Tool::turn ? "turn" : "scale"; }

} // namespace

Matrix16 view_matrix(const GizmoFrame& frame)
{
  const glm::dvec3 eye = (frame.sight.position - frame.base) / frame.unit;
  const std::array<glm::dvec3, 3> rows{frame.sight.right, frame.sight.up, -frame.sight.forward};
  Matrix16 m{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) m[4 * static_cast<std::size_t>(i) + row] = static_cast<float>(rows[row][i]);
    m[12 + row] = static_cast<float>(-glm::dot(rows[row], eye));
  }
  m[15] = 1;
  return m;
}

Matrix16 projection_matrix(const Sight& sight, const Canvas& canvas)
{
  // From the picture's -1..1 to the canvas' own: scale and shift along each axis.
  std::array<double, 2> scale{}, shift{};
  for (std::size_t i = 0; i < 2; ++i) {
    scale[i] = sight.size[i] / canvas.size[i];
    shift[i] = (2 * (sight.corner[i] - canvas.corner[i]) + sight.size[i]) / canvas.size[i] - 1;
  }
  constexpr double near = 0.05, far = 10; // in the frame's units; nothing is cut off there
  Matrix16 m{};
  m[0] = static_cast<float>(scale[0] / sight.tan_x);
  m[5] = static_cast<float>(scale[1] / sight.tan_y);
  m[8] = static_cast<float>(-shift[0]);
  m[9] = static_cast<float>(shift[1]); // down on the screen
  m[10] = static_cast<float>(-(far + near) / (far - near));
  m[11] = -1;
  m[14] = static_cast<float>(-2 * far * near / (far - near));
  return m;
}

Gizmo::Gizmo() { let_go(); }

void Gizmo::draw(const Context& context, const Sight& sight, const Canvas& canvas, bool hovered)
{
  prepare(canvas);
  places_.reset();
  const Selection selection = context.selection();
  if (drag_ && (drag_->selection != selection || !context.chosen.handles.shown)) end_drag(context);
  const auto grip = context.preset() ? grip_of(*context.preset(), selection, context.run.seen<SeenScene>().get()) : std::nullopt;
  if (!grip || !context.chosen.handles.shown) return;
  const Handles& handles = context.chosen.handles;
  const GizmoFrame frame = drag_ ? drag_->frame : GizmoFrame{sight, grip->at, sight.depth(grip->at)};
  if (!(frame.unit > 0)) return; // behind the camera
  const Tool tool = drag_ ? drag_->tool : usable_tool(*grip, handles.tool);
  const bool own_axes = drag_ ? drag_->own_axes : handles.own_axes || tool == Tool::scale;
  Matrix16 matrix = drag_ ? drag_->matrix : placed(grip->axes);
  const Matrix16 view = view_matrix(frame), projection = projection_matrix(frame.sight, canvas);
  const bool snaps = handles.snap != ImGui::GetIO().KeyCtrl;
  const std::array<float, 3> steps = snap_steps(tool, frame.unit);
  const auto manipulate = [&] {
    ImGuizmo::Manipulate(view.data(), projection.data(), operation(tool, *grip), own_axes ? ImGuizmo::LOCAL : ImGuizmo::WORLD,
                         matrix.data(), nullptr, snaps ? steps.data() : nullptr);
  };
  if (hovered || drag_) {
    const NothingHovered nothing;
    manipulate();
  } else
    manipulate();
  note_places(frame, own_axes ? grip->axes : glm::dmat3(1));
  if (!drag_ && ImGuizmo::IsUsing()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    drag_ = Drag{*context.preset(), *context.preset(), selection, *grip, frame, tool, own_axes, ImGuizmo::GetActiveHandleType(),
                 {mouse.x, mouse.y}};
    drag_->matrix = matrix;
    gestures_.begin();
  }
  if (!drag_) return;
  drag_->snaps = snaps;
  follow(context, matrix);
  if (!drag_->text.empty()) draw_text_at((*places_)[0], drag_->text);
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) end_drag(context);
}

void Gizmo::rest(const Context& context)
{
  places_.reset();
  if (drag_) end_drag(context);
}

void Gizmo::end_drag(const Context& context)
{
  if (ImGuizmo::IsUsingAny()) let_go();
  drag_.reset();
  context.push(command::EndGesture{});
}

void Gizmo::follow(const Context& context, const Matrix16& matrix)
{
  // Near the horizon of a plane a pixel is any length, and beyond it there is no place.
  if (drag_->tool != Tool::scale) {
    const bool is_place = std::ranges::all_of(matrix, [](float value) { return std::abs(value) < farthest; });
    if (!is_place) return;
    drag_->matrix = matrix;
  }
  preset::Preset edited = drag_->start;
  std::string text = edit(edited, matrix);
  if (edited.scene == drag_->newest.scene || !make_sight(edited.scene.camera, {}, {1, 1})) return;
  drag_->newest = edited;
  drag_->text = std::move(text);
  context.push(command::Edit{fmt::format("{} {}", verb(drag_->tool), name_of(edited, drag_->selection)), std::move(edited),
                             gestures_.number(), true});
}

/// Changes the preset of the drag's start; returns what that is in words.
std::string Gizmo::edit(preset::Preset& edited, const Matrix16& matrix) const
{
  const Drag& d = *drag_;
  switch (d.tool) {
  case Tool::move: {
    const glm::dvec3 by = d.frame.unit * column(matrix, 3);
    const int decimals = decimals_for(d.frame.unit);
    move(edited, d.selection, by, decimals);
    const int shown = std::max(0, decimals - 1);
    return fmt::format("{:+.{}f}, {:+.{}f}, {:+.{}f} {}", by.x, shown, by.y, shown, by.z, shown, unit_word(edited));
  }
  case Tool::turn: {
    const int which = d.handle - ImGuizmo::MT_ROTATE_X;
    const glm::dvec3 axis = which == 3 ? -d.frame.sight.forward : d.own_axes ? d.grip.axes[which] : glm::dmat3(1)[which];
    const double degrees = std::round(10 * degrees_about(axis, matrix, d.grip.axes)) / 10;
    turn(edited, d.selection, d.grip, axis, degrees);
    return fmt::format("{:+.1f} degrees", degrees);
  }
  case Tool::scale:
    break;
  }
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec3 factors = factors_of(d.frame, d.grip.axes, d.handle, d.from, {mouse.x, mouse.y}, d.snaps ? snap_factor : 0);
  stretch(edited, d.selection, d.grip, factors);
  return fmt::format("times {:.3f}, {:.3f}, {:.3f}", factors.x, factors.y, factors.z);
}

void Gizmo::note_places(const GizmoFrame& frame, const glm::dmat3& axes)
{
  const glm::dvec3 middle = drag_ ? frame.base + frame.unit * column(drag_->matrix, 3) : frame.base;
  const double pixel = 2 * frame.unit * frame.sight.tan_x / frame.sight.size[0];
  const double length = handle_em * ImGui::GetFontSize() * pixel;
  std::array<Point, 4> places{};
  for (int i = 0; i < 4; ++i)
    places[static_cast<std::size_t>(i)] =
        frame.sight.to_screen(i == 0 ? middle : middle + length * axes[i - 1]).value_or(Point{-1e9, -1e9});
  places_ = places;
}

} // namespace nephroid::ui
