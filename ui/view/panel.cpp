// SPDX-License-Identifier: Apache-2.0
#include "ui/view/panel.h"

#include "ui/view/bars.h"
#include "ui/widgets/action.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>

namespace nephroid::ui {
namespace {

constexpr double orbit_deg_per_height = 180; ///< dragging over the picture's height goes half round
constexpr double click_trembles = 3;         ///< pixels at scale 1: a mouse that went no farther was clicked
constexpr double notch = 1.1;                ///< a notch of the wheel changes distance or zoom by this factor
constexpr double wheel_gesture_s = 0.6;      ///< a longer rest starts a new entry to undo
constexpr double pixel_squares_from = 3;     ///< at this zoom and above pixels are shown as squares

Point mouse() { return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}; }

/// About pixels from `from` to before `to`, at least so many pixels of the screen large; seen on any colour.
void draw_frame(const Placement& placement, const std::array<int, 2>& from, const std::array<int, 2>& to, ImU32 colour, double least)
{
  Point low = placement.to_screen({static_cast<double>(from[0]), static_cast<double>(from[1])});
  Point high = placement.to_screen({static_cast<double>(to[0]), static_cast<double>(to[1])});
  for (std::size_t i = 0; i < 2; ++i)
    if (const double missing = least - (high[i] - low[i]); missing > 0) low[i] -= missing / 2, high[i] += missing / 2;
  for (const auto& [margin, line] : {std::pair{2, colour::outline}, std::pair{1, colour}, std::pair{0, colour::outline}})
    ImGui::GetWindowDrawList()->AddRect(vec({low[0] - margin, low[1] - margin}), vec({high[0] + margin, high[1] + margin}), line);
}

/// The pixel and the rectangle that the panel Inspector is about.
void draw_marks(const Chosen& chosen, const Placement& placement, const std::array<int, 2>& picture)
{
  if (const auto& region = chosen.region) {
    const std::array to{std::min(region->to[0], picture[0]), std::min(region->to[1], picture[1])};
    if (region->from[0] < to[0] && region->from[1] < to[1]) draw_frame(placement, region->from, to, colour::accent, 0);
  }
  if (const auto& pixel = chosen.pixel; pixel && (*pixel)[0] < picture[0] && (*pixel)[1] < picture[1])
    draw_frame(placement, *pixel, {(*pixel)[0] + 1, (*pixel)[1] + 1}, colour::on_dark, 5);
}

} // namespace

void ViewPanel::draw(const Context& context)
{
  shown_ = shown_picture(context);
  places_.clear();
  bars_.begin();
  bars_.bar([&] { draw_toolbar(context); });
  bars_.bar([&] { draw_look_bar(context, tone_, places_); });
  bars_.bar([&] { draw_comparison_bar(context); });
  bars_.bar([&] { draw_selection_bar(context, places_); });
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  canvas_ = {{corner.x, corner.y}, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)}};
  ImGui::InvisibleButton("picture", vec(canvas_.size),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  hovered_ = ImGui::IsItemHovered();
  own_keys(context);
  pressed_ = ImGui::IsItemActivated();
  held_ = ImGui::IsItemActive();
  refresh_texture(context);
  const auto& map = context.comparing.difference();
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  draw_list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, colour::surround);
  draw_picture(context);
  overlay_.draw(context, canvas_, shown_.size, hovered_);
  use_mouse(context); // after the handles, which have it first
  if (!shown_.hint.empty()) draw_hint(colour::quiet_on_dark, corner, vec(canvas_.size), shown_.hint);
  draw_marks(context.chosen, place(context.chosen.look, canvas_, shown_.size), shown_.size);
  if (!shown_.label.empty()) draw_overlay({corner.x + ImGui::GetFontSize() * 0.4f, corner.y + ImGui::GetFontSize() * 0.4f}, shown_.label);
  if (map && map == shown_.owner) draw_difference_scale(*map, canvas_);
  if (!shown_.rgb.empty() && tone_.curve == ToneCurve::false_colour) draw_luminance_scale(tone_.range, canvas_);
  draw_pixel_value(context);
  draw_list->PopClipRect();
}

void ViewPanel::draw_toolbar(const Context& context)
{
  Look look = context.look();
  float stops = static_cast<float>(look.exposure_stops);
  draw_label("Exposure");
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
  if (ImGui::SliderFloat("##exposure", &stops, -10, 10, "%+.2f stops", ImGuiSliderFlags_NoRoundToFormat)) {
    look.exposure_stops = stops;
    context.push(command::SetLook{look});
  }
  tooltip("Brighter E, darker Shift+E, as it is 0. Ctrl+click to type. The run goes on.");
  if (!context.preset()) return;
  const auto& size = shown_.size;
  ImGui::SameLine(0, ImGui::GetFontSize());
  action_button("Fit", context);
  ImGui::SameLine();
  ImGui::TextDisabled("%.0f %%   %d x %d", 100 * place(look, canvas_, size).scale, size[0], size[1]);
}

void ViewPanel::refresh_texture(const Context& context)
{
  if (!shown_.owner) return;
  const Look& look = context.chosen.look;
  const double white = context.preset() ? context.preset()->white : 1;
  const bool toned = !shown_.rgb.empty(), same_tone = look.exposure_stops == look_in_texture_.exposure_stops &&
                                                      look.tone == look_in_texture_.tone &&
                                                      look.false_colour == look_in_texture_.false_colour && white == white_in_texture_;
  if (shown_.owner == in_texture_ && (!toned || same_tone)) return;
  const std::span<unsigned char> bytes = texture_.edit(shown_.size[0], shown_.size[1]);
  if (toned) {
    tone_ = tone_of(look, white, shown_.rgb);
    toned_pixels(shown_.rgb, tone_, bytes);
  } else
    std::copy(shown_.rgba.begin(), shown_.rgba.end(), bytes.begin());
  in_texture_ = shown_.owner;
  look_in_texture_ = look;
  white_in_texture_ = white;
}

void ViewPanel::draw_picture(const Context& context)
{
  if (!shown_.owner) return;
  const auto& size = shown_.size;
  const Placement placement = place(context.chosen.look, canvas_, size);
  const ImVec2 from = vec(placement.to_screen({0, 0}));
  const ImVec2 to = vec(placement.to_screen({static_cast<double>(size[0]), static_cast<double>(size[1])}));
  texture_.draw(from, to, placement.scale >= pixel_squares_from);
  ImGui::GetWindowDrawList()->AddRect({from.x - 1, from.y - 1}, {to.x + 1, to.y + 1}, colour::frame);
}

/// What the pixel under the cursor is, in the picture's lower left corner.
void ViewPanel::draw_pixel_value(const Context& context) const
{
  if (!hovered_ || !context.run.snapshot()) return;
  const auto pixel = pixel_at(place(context.chosen.look, canvas_, shown_.size), shown_.size, mouse());
  if (!pixel) return;
  const std::string text = pixel_text(context, *pixel);
  const float pad = ImGui::GetFontSize() * 0.4f;
  draw_overlay(vec({canvas_.corner[0] + pad, canvas_.corner[1] + canvas_.size[1] - ImGui::CalcTextSize(text.c_str()).y - 3 * pad}), text);
}

/// Alt with the mouse on the picture opens no menu, and while a pixel is inspected or a thing is selected the arrow keys are theirs, not
/// the keyboard's cursor's.
void ViewPanel::own_keys(const Context& context)
{
  ImGui::SetItemKeyOwner(ImGuiMod_Alt);
  if ((!context.chosen.pixel && context.selection() == Selection{}) || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return;
  for (const ImGuiKey key : {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow})
    ImGui::SetKeyOwner(key, ImGui::GetItemID());
  if (context.selection() == Selection{}) return;
  for (const ImGuiKey key : {ImGuiKey_PageUp, ImGuiKey_PageDown}) ImGui::SetKeyOwner(key, ImGui::GetItemID());
}

void ViewPanel::use_mouse(const Context& context)
{
  if (!context.preset()) return;
  if (pressed_ && !overlay_.has_mouse()) start_drag(context);
  if (drag_ != Drag::none) continue_drag(context);
  if (hovered_ && ImGui::GetIO().MouseWheel != 0) use_wheel(context);
}

void ViewPanel::start_drag(const Context& context)
{
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl)
    drag_ = Drag::move_picture;
  else if (io.KeyAlt && ImGui::IsMouseDown(ImGuiMouseButton_Left))
    drag_ = Drag::mark, marks_region_ = false;
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyShift))
    drag_ = Drag::pan;
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
    drag_ = Drag::dolly;
  else
    drag_ = Drag::orbit;
  drag_from_ = mouse();
  moved_ = false;
  camera_at_start_ = context.preset()->scene.camera;
  look_at_start_ = context.chosen.look;
  gestures_.begin();
}

void ViewPanel::continue_drag(const Context& context)
{
  const ImVec2 step = ImGui::GetIO().MouseDelta;
  const Point delta{mouse()[0] - drag_from_[0], mouse()[1] - drag_from_[1]};
  moved_ = moved_ || std::hypot(delta[0], delta[1]) > click_trembles * scale();
  if (moved_ && (step.x != 0 || step.y != 0)) {
    if (drag_ == Drag::move_picture) {
      const Look moved = dragged(look_at_start_, canvas_, shown_.size, delta);
      Look look = context.look();
      look.fit = moved.fit;
      look.zoom = moved.zoom;
      look.centre = moved.centre;
      context.push(command::SetLook{look});
    } else if (drag_ != Drag::mark)
      move_camera(context, delta);
  }
  if (drag_ == Drag::mark) mark(context);
  if (held_) return;
  if (drag_ == Drag::orbit && !moved_) overlay_.click(context, drag_from_);
  drag_ = Drag::none;
  context.push(command::EndGesture{});
}

void ViewPanel::move_camera(const Context& context, const Point& delta) const
{
  const double height = place(context.chosen.look, canvas_, shown_.size).scale * shown_.size[1];
  const double across = delta[0] / height, down = delta[1] / height;
  const auto edit = [&](const char* label, const preset::Camera& camera) {
    context.edit(
        label, [&](preset::Preset& p) { p.scene.camera = camera; }, gestures_.number(), true);
  };
  if (drag_ == Drag::orbit) // the scene follows the mouse: to the right means that the camera goes to the left
    edit("orbit", orbit(camera_at_start_, -orbit_deg_per_height * across, orbit_deg_per_height * down));
  else if (drag_ == Drag::pan)
    edit("move the camera", pan(camera_at_start_, across, down));
  else
    edit("distance of the camera", dolly(camera_at_start_, std::exp2(2 * down)));
}

/// A click takes a pixel, a drag a rectangle, which follows the mouse.
void ViewPanel::mark(const Context& context)
{
  const Placement placement = place(context.chosen.look, canvas_, shown_.size);
  const double way = std::hypot(mouse()[0] - drag_from_[0], mouse()[1] - drag_from_[1]);
  marks_region_ = marks_region_ || way >= ImGui::GetIO().MouseDragThreshold;
  if (marks_region_) context.push(command::SelectRegion{region_between(placement, shown_.size, drag_from_, mouse())});
  if (held_) return;
  if (!marks_region_) context.push(command::InspectPixel{pixel_at(placement, shown_.size, mouse())});
  context.push(command::ShowPanel{"inspector"});
}

void ViewPanel::use_wheel(const Context& context)
{
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) {
    context.push(command::SetLook{zoomed(context.look(), canvas_, shown_.size, mouse(), std::pow(notch, io.MouseWheel))});
    return;
  }
  const double now = ImGui::GetTime();
  if (last_wheel_s_ < 0 || now - last_wheel_s_ > wheel_gesture_s) gestures_.begin();
  last_wheel_s_ = now;
  const double factor = std::pow(notch, -io.MouseWheel);
  context.edit(
      "distance of the camera", [&](preset::Preset& p) { p.scene.camera = dolly(p.scene.camera, factor); }, gestures_.number());
}

} // namespace nephroid::ui
