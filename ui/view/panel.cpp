// SPDX-License-Identifier: Apache-2.0
#include "ui/view/panel.h"

#include "engine/engine.h"
#include "ui/view/bars.h"
#include "ui/widgets/colour_scale.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

constexpr double orbit_deg_per_height = 180; ///< dragging over the picture's height goes half around the target
constexpr double click_trembles = 3;         ///< pixels at scale 1: a smaller movement is a click
constexpr double notch = 1.1;                ///< a notch of the wheel changes distance or zoom by this factor
constexpr double wheel_gesture_s = 0.6;      ///< a longer pause starts a new entry to undo
constexpr double pixel_squares_from = 3;     ///< from this zoom on, pixels appear as squares

Point mouse() { return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}; }

/// Draws a frame about pixels from `from` to before `to`, of a least size on the screen, visible on any colour.
void draw_frame(const Placement& placement, const std::array<int, 2>& from, const std::array<int, 2>& to, ImU32 colour,
                double least) {
  Point low = placement.to_screen({static_cast<double>(from[0]), static_cast<double>(from[1])});
  Point high = placement.to_screen({static_cast<double>(to[0]), static_cast<double>(to[1])});
  for (std::size_t i = 0; i < 2; ++i)
    if (const double missing = least - (high[i] - low[i]); missing > 0) low[i] -= missing / 2, high[i] += missing / 2;
  for (const auto& [margin, line] :
       {std::pair{2.0f, colour::outline}, std::pair{1.0f, colour}, std::pair{0.0f, colour::outline}})
    ImGui::GetWindowDrawList()->AddRect(vec(low) - ImVec2(margin, margin), vec(high) + ImVec2(margin, margin), line);
}

void draw_marks(const ViewState& view_state, const Placement& placement, const std::array<int, 2>& picture) {
  if (const auto& region = view_state.region) {
    const std::array to{std::min(region->to[0], picture[0]), std::min(region->to[1], picture[1])};
    if (region->from[0] < to[0] && region->from[1] < to[1]) draw_frame(placement, region->from, to, colour::accent, 0);
  }
  if (const auto& pixel = view_state.pixel; pixel && (*pixel)[0] < picture[0] && (*pixel)[1] < picture[1])
    draw_frame(placement, *pixel, {(*pixel)[0] + 1, (*pixel)[1] + 1}, colour::on_dark, 5);
}

/// Draws a panel's lines in the picture (command::ShowLines), with a dark rim.
void draw_lines(const Context& context, const Placement& placement, const std::array<int, 2>& picture) {
  if (context.view_state.lines.empty() || !context.comparing.shows_run_alone()) return;
  const auto pinhole = make_pinhole(engine::camera_of(*context.preset()), placement, picture);
  if (!pinhole) return;
  for (const auto& [colour, width] : {std::pair{colour::outline, 3.0f}, std::pair{colour::accent, 1.5f}})
    for (const std::vector<preset::Vec3>& line : context.view_state.lines)
      for (std::size_t i = 1; i < line.size(); ++i) {
        const auto from = pinhole->to_screen(to_vector(line[i - 1])), to = pinhole->to_screen(to_vector(line[i]));
        if (from && to) ImGui::GetWindowDrawList()->AddLine(vec(*from), vec(*to), colour, width * scale());
      }
}

/// Draws a picture's label and the marks of the panel Inspector.
void draw_marked(const Context& context, const ShownPicture& shown, const Canvas& seen, const Placement& placement) {
  if (!shown.hint.empty()) draw_hint(colour::quiet_on_dark, vec(seen.corner), vec(seen.size), shown.hint);
  draw_marks(context.view_state, placement, shown.size);
  const float pad = 0.4f * em();
  if (!shown.label.empty()) draw_overlay(vec(seen.corner) + ImVec2(pad, pad), shown.label);
}

PictureAreas areas_of(const Comparison& comparison, const Canvas& area) {
  if (comparison.arrangement == Arrangement::single) return {area, area, {}};
  const bool split = comparison.arrangement == Arrangement::split;
  const double line = std::round(area.size[0] * (split ? comparison.split : 0.5));
  PictureAreas areas{area, area, {{area.corner[0] + line, area.corner[1]}, {area.size[0] - line, area.size[1]}}};
  areas.first.size[0] = line;
  if (split) return areas;
  areas.canvas.size[0] = std::max(line, 1.0);
  areas.shift = line;
  return areas;
}

/// Alt with the mouse on the picture opens no menu. While a pixel is inspected or something is selected, the arrow keys
/// move that and not the keyboard's cursor. Otherwise they go from picture to picture, unless a person goes from widget
/// to widget by the keyboard.
void own_keys(const Context& context) {
  ImGui::SetItemKeyOwner(ImGuiMod_Alt);
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return;
  if (!context.view_state.pixel && context.selection() == Selection{}) {
    if (context.comparing.pinned().all().empty() || ImGui::GetIO().NavVisible) return;
    for (const ImGuiKey key : {ImGuiKey_UpArrow, ImGuiKey_DownArrow}) ImGui::SetKeyOwner(key, ImGui::GetItemID());
    return;
  }
  for (const ImGuiKey key : {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow})
    ImGui::SetKeyOwner(key, ImGui::GetItemID());
  if (context.selection() == Selection{}) return;
  for (const ImGuiKey key : {ImGuiKey_PageUp, ImGuiKey_PageDown}) ImGui::SetKeyOwner(key, ImGui::GetItemID());
}

} // namespace

void PictureOnScreen::refresh(const Context& context, const ShownPicture& shown, const Tone* like) {
  if (!shown.owner) return;
  const ViewSettings& now = context.view_state.view_settings;
  const bool is_linear = !shown.rgb.empty();
  const image::Display display_now = context.display();
  const bool same_settings = now.exposure_stops == view_settings.exposure_stops &&
                             now.false_colour == view_settings.false_colour && now.range == view_settings.range &&
                             display_now == display && context.white() == white && (!like || *like == tone);
  if (shown.owner == owner && (!is_linear || same_settings)) return;
  const std::span<unsigned char> bytes = texture.edit(shown.size[0], shown.size[1]);
  if (is_linear) {
    tone = like ? *like : tone_of(now, display_now, context.white(), shown.rgb);
    toned_pixels(shown.rgb, tone, bytes);
  } else
    std::copy(shown.rgba.begin(), shown.rgba.end(), bytes.begin());
  owner = shown.owner;
  view_settings = now;
  display = display_now;
  white = context.white();
}

void PictureOnScreen::draw(const ShownPicture& shown, const Placement& placement) const {
  if (!shown.owner) return;
  const ImVec2 from = vec(placement.to_screen({0, 0}));
  const ImVec2 to = vec(placement.to_screen({static_cast<double>(shown.size[0]), static_cast<double>(shown.size[1])}));
  texture.draw(from, to, placement.scale >= pixel_squares_from);
  ImGui::GetWindowDrawList()->AddRect(from - ImVec2(1, 1), to + ImVec2(1, 1), colour::frame);
}

void ViewPanel::draw(const Context& context) {
  shown_ = shown_picture(context);
  beside_ = picture_beside(context);
  places_.clear();
  // A small panel shows the picture alone: the menus have all of the bars' actions.
  if (ImGui::GetContentRegionAvail().y > 16 * em()) {
    bars_.begin();
    bars_.bar([&] { draw_toolbar(context); });
    bars_.bar([&] { draw_view_bar(context, first_.tone, places_); });
    bars_.bar([&] { draw_comparison_bar(context, places_); });
    bars_.bar([&] { draw_selection_bar(context, places_); });
    if (context.preset()->animation) bars_.bar([&] { draw_time_bar(context, places_); });
    draw_metrics(context, places_);
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  const Canvas area{{corner.x, corner.y}, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)}};
  areas_ = areas_of(context.comparing.comparison(), area);
  ImGui::SetNextItemAllowOverlap();
  ImGui::InvisibleButton("picture", vec(area.size),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                             ImGuiButtonFlags_MouseButtonRight);
  hovered_ = ImGui::IsItemHovered();
  own_keys(context);
  pressed_ = ImGui::IsItemActivated();
  held_ = ImGui::IsItemActive();
  if (!held_ || pressed_) on_second_ = areas_.second.size[0] > 0 && mouse()[0] >= areas_.second.corner[0];
  take_line(context, area);
  first_.refresh(context, shown_);
  second_.refresh(context, beside_, shown_.rgb.empty() ? nullptr : &first_.tone);
  map_.refresh(context);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->PushClipRect(corner, corner + size, true);
  draw_list->AddRectFilled(corner, corner + size, colour::surround);
  draw_pictures(context);
  if (const auto& map = context.comparing.difference(); map && map == shown_.owner) draw_difference_scale(*map, area);
  if (!shown_.rgb.empty() && first_.tone.false_colour) draw_luminance_scale(*first_.tone.false_colour, area);
  if (map_.is_shown()) draw_linear_scale(vec(area.corner), vec(area.size), map_.unit(), map_.high());
  draw_pixel_value(context, area);
  draw_list->PopClipRect();
}

/// Draws the line between two pictures, and lets the mouse move it.
void ViewPanel::take_line(const Context& context, const Canvas& area) {
  if (context.comparing.comparison().arrangement != Arrangement::split) return;
  const float reach = 0.4f * em(), x = static_cast<float>(areas_.second.corner[0]);
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({x - reach, static_cast<float>(area.corner[1])});
  ImGui::InvisibleButton("line", {2 * reach, static_cast<float>(area.size[1])});
  places_.note("line");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    hovered_ = false;
  }
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0)
    context.push(command::MoveSplit{(mouse()[0] - area.corner[0]) / area.size[0]});
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) context.push(command::MoveSplit{});
  ImGui::SetCursorScreenPos(after);
}

void ViewPanel::draw_toolbar(const Context& context) {
  ViewSettings view_settings = context.view_settings();
  float stops = static_cast<float>(view_settings.exposure_stops);
  draw_label("Exposure");
  ImGui::SetNextItemWidth(12 * em());
  if (ImGui::SliderFloat("##exposure", &stops, -10, 10, "%+.2f stops", ImGuiSliderFlags_NoRoundToFormat)) {
    view_settings.exposure_stops = stops;
    context.push(command::SetViewSettings{view_settings});
  }
  tooltip("Brighter E, darker Shift+E, as it is 0. Ctrl+click to type. The run goes on.");
  const auto& size = shown_.size;
  ImGui::SameLine(0, em());
  action_button("Fit", context);
  ImGui::SameLine();
  ImGui::TextDisabled("%.0f %%   %d x %d", 100 * place(view_settings, areas_.canvas, size).scale, size[0], size[1]);
}

void ViewPanel::draw_pictures(const Context& context) {
  const Placement first = placed(context);
  Placement second = first;
  second.origin[0] += areas_.shift;
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  const auto within = [&](const Canvas& seen, auto draw) {
    draw_list->PushClipRect(vec(seen.corner), vec(seen.corner) + vec(seen.size), true);
    draw();
    draw_list->PopClipRect();
  };
  within(areas_.first, [&] {
    first_.draw(shown_, first);
    map_.draw(first);
    draw_lines(context, first, shown_.size);
    overlay_.draw(context, areas_.canvas, shown_.size, hovered_ && !on_second_);
  });
  use_mouse(context); // after the handles, which come first
  within(areas_.first, [&] { draw_marked(context, shown_, areas_.first, first); });
  if (context.comparing.comparison().arrangement == Arrangement::single) return;
  within(areas_.second, [&] {
    second_.draw(beside_, second);
    draw_marked(context, beside_, areas_.second, second);
  });
  const float line = static_cast<float>(areas_.second.corner[0]), top = static_cast<float>(areas_.second.corner[1]);
  const float foot = top + static_cast<float>(areas_.second.size[1]);
  draw_list->AddLine({line, top}, {line, foot}, colour::outline, 3);
  draw_list->AddLine({line, top}, {line, foot}, colour::on_dark, 1);
  const auto pixel = hovered_ ? pointed_pixel(context) : std::nullopt; // also while the mouse is in the other picture
  if (!pixel || areas_.shift == 0) return;
  within(on_second_ ? areas_.first : areas_.second, [&] {
    draw_frame(on_second_ ? first : second, *pixel, {(*pixel)[0] + 1, (*pixel)[1] + 1}, colour::on_dark, 5);
  });
}

/// The mouse's position relative to the first picture.
Point ViewPanel::pointer() const { return {mouse()[0] - (on_second_ ? areas_.shift : 0), mouse()[1]}; }

/// The pixel under the mouse, in the first picture or in the one beside it, which may be larger.
std::optional<std::array<int, 2>> ViewPanel::pointed_pixel(const Context& context) const {
  const std::array size{std::max(shown_.size[0], beside_.size[0]), std::max(shown_.size[1], beside_.size[1])};
  return pixel_at(placed(context), size, pointer());
}

void ViewPanel::draw_pixel_value(const Context& context, const Canvas& area) {
  const auto pixel = hovered_ ? pointed_pixel(context) : std::nullopt;
  pixel_value_ = pixel ? pixel_text(context, *pixel) : std::string();
  if (pixel_value_.empty()) return;
  const float pad = 0.4f * em();
  draw_overlay(vec({area.corner[0] + pad,
                    area.corner[1] + area.size[1] - ImGui::CalcTextSize(pixel_value_.c_str()).y - 3 * pad}),
               pixel_value_);
}

void ViewPanel::use_mouse(const Context& context) {
  if (pressed_ && !overlay_.has_mouse()) start_drag(context);
  if (drag_ != Drag::none) continue_drag(context);
  if (hovered_ && ImGui::GetIO().MouseWheel != 0) use_wheel(context);
}

void ViewPanel::start_drag(const Context& context) {
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
  // An opened picture was not taken by a camera of the preset.
  const bool is_of_camera = context.comparing.comparison().shown == 0;
  if (!is_of_camera && drag_ != Drag::mark) drag_ = Drag::move_picture;
  drag_from_ = pointer();
  moved_ = false;
  camera_at_start_ = engine::camera_of(*context.preset());
  settings_at_start_ = context.view_state.view_settings;
  gestures_.begin();
}

void ViewPanel::continue_drag(const Context& context) {
  const ImVec2 step = ImGui::GetIO().MouseDelta;
  const Point delta{pointer()[0] - drag_from_[0], pointer()[1] - drag_from_[1]};
  moved_ = moved_ || std::hypot(delta[0], delta[1]) > click_trembles * scale();
  if (moved_ && (step.x != 0 || step.y != 0)) {
    if (drag_ == Drag::move_picture) {
      const ViewSettings moved = dragged(settings_at_start_, areas_.canvas, shown_.size, delta);
      ViewSettings view_settings = context.view_settings();
      view_settings.fit = moved.fit;
      view_settings.zoom = moved.zoom;
      view_settings.centre = moved.centre;
      context.push(command::SetViewSettings{view_settings});
    } else if (drag_ != Drag::mark)
      move_camera(context, delta);
  }
  if (drag_ == Drag::mark) mark(context);
  if (held_) return;
  if (drag_ == Drag::orbit && !moved_ && !on_second_) overlay_.click(context, drag_from_);
  drag_ = Drag::none;
  context.push(command::EndGesture{});
}

void ViewPanel::move_camera(const Context& context, const Point& delta) const {
  const double height = placed(context).scale * shown_.size[1];
  const double across = delta[0] / height, down = delta[1] / height;
  const auto edit = [&](const char* label, const preset::Camera& camera) {
    context.edit(
        label, [&](preset::Preset& p) { p.scene.camera = camera; }, gestures_.number(), true);
  };
  if (drag_ == Drag::orbit) // the scene follows the mouse: a drag to the right moves the camera to the left
    edit("orbit", orbit(camera_at_start_, -orbit_deg_per_height * across, orbit_deg_per_height * down));
  else if (drag_ == Drag::pan)
    edit("move the camera", pan(camera_at_start_, across, down));
  else
    edit("distance of the camera", dolly(camera_at_start_, std::exp2(2 * down)));
}

/// Marks a pixel by a click, or a rectangle by a drag, which follows the mouse.
void ViewPanel::mark(const Context& context) {
  const Placement placement = placed(context);
  const double way = std::hypot(pointer()[0] - drag_from_[0], pointer()[1] - drag_from_[1]);
  marks_region_ = marks_region_ || way >= ImGui::GetIO().MouseDragThreshold;
  if (marks_region_) context.push(command::SelectRegion{region_between(placement, shown_.size, drag_from_, pointer())});
  if (held_) return;
  if (!marks_region_) context.push(command::InspectPixel{pixel_at(placement, shown_.size, pointer())});
  context.push(command::ShowPanel{"inspector"});
}

void ViewPanel::use_wheel(const Context& context) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl || context.comparing.comparison().shown != 0) {
    context.push(command::SetViewSettings{
        zoomed(context.view_settings(), areas_.canvas, shown_.size, pointer(), std::pow(notch, io.MouseWheel))});
    return;
  }
  const double now = ImGui::GetTime();
  if (last_wheel_s_ < 0 || now - last_wheel_s_ > wheel_gesture_s) gestures_.begin();
  last_wheel_s_ = now;
  const double factor = std::pow(notch, -io.MouseWheel);
  context.edit(
      "distance of the camera", [&](preset::Preset& p) { p.scene.camera = dolly(engine::camera_of(p), factor); },
      gestures_.number());
}

} // namespace nephroid::ui
