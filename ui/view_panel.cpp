// SPDX-License-Identifier: Apache-2.0
#include "ui/view_panel.h"

#include "ui/camera_moves.h"
#include "ui/shown_pixels.h"
#include "ui/theme.h"
#include "ui/workbench.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

namespace nephroid::ui {
namespace {

constexpr double orbit_deg_per_height = 180; ///< dragging over the picture's height goes half round
constexpr double notch = 1.1;                ///< a notch of the wheel changes distance or zoom by this factor
constexpr double wheel_gesture_s = 0.6;      ///< a longer rest starts a new entry to undo
constexpr double pixel_squares_from = 3;     ///< at this zoom and above pixels are shown as squares

std::array<int, 2> picture_size(const Workbench& workbench)
{
  if (const auto& snapshot = workbench.snapshot()) return {snapshot->picture->width, snapshot->picture->height};
  if (const preset::Preset* preset = workbench.preset()) return preset->scene.camera.resolution;
  return {1, 1};
}

/// Whether the renderer has no texture of the picture's size (0: it has every size).
bool too_large(const job::Picture& picture)
{
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  const auto beyond = [](int size, int limit) { return limit > 0 && size > limit; };
  return beyond(picture.width, platform.Renderer_TextureMaxWidth) || beyond(picture.height, platform.Renderer_TextureMaxHeight);
}

std::string too_large_hint(const job::Picture& picture)
{
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  return fmt::format("The picture is {} x {}; this display's OpenGL shows at most {} x {}. It is computed all the same: "
                     "save it with Ctrl+E, or lower scene.camera.resolution.",
                     picture.width, picture.height, platform.Renderer_TextureMaxWidth, platform.Renderer_TextureMaxHeight);
}

Point mouse() { return {ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y}; }
ImVec2 vec(const Point& p) { return {static_cast<float>(p[0]), static_cast<float>(p[1])}; }

} // namespace

void ViewPanel::draw(const Workbench& workbench, Commands& commands)
{
  draw_toolbar(workbench, commands);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  canvas_ = {{corner.x, corner.y}, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)}};
  ImGui::InvisibleButton("picture", vec(canvas_.size),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  hovered_ = ImGui::IsItemHovered();
  use_mouse(workbench, commands);
  refresh_texture(workbench);
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  draw_list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, colour::surround);
  draw_picture(workbench);
  draw_hint(workbench);
  draw_pixel_value(workbench);
  draw_list->PopClipRect();
}

void ViewPanel::draw_toolbar(const Workbench& workbench, Commands& commands)
{
  Look look = workbench.look();
  float stops = static_cast<float>(look.exposure_stops);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Exposure");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
  if (ImGui::SliderFloat("##exposure", &stops, -10, 10, "%+.2f stops", ImGuiSliderFlags_NoRoundToFormat)) {
    look.exposure_stops = stops;
    commands.push_back(command::SetLook{look});
  }
  ImGui::SetItemTooltip("Brighter E, darker Shift+E, as it is 0. Ctrl+click to type. The run goes on.");
  if (!workbench.preset()) return;
  const auto size = picture_size(workbench);
  ImGui::SameLine(0, ImGui::GetFontSize());
  if (ImGui::Button("Fit")) {
    look.fit = true;
    commands.push_back(command::SetLook{look});
  }
  ImGui::SetItemTooltip("The whole picture: F. Ctrl+wheel zooms about the cursor, Ctrl+drag moves it.");
  ImGui::SameLine();
  ImGui::TextDisabled("%.0f %%   %d x %d", 100 * place(look, canvas_, size).scale, size[0], size[1]);
}

void ViewPanel::refresh_texture(const Workbench& workbench)
{
  const auto& snapshot = workbench.snapshot();
  const double stops = workbench.look().exposure_stops;
  if (!snapshot || (snapshot == in_texture_ && stops == stops_in_texture_)) return;
  const job::Picture& picture = *snapshot->picture;
  if (too_large(picture)) return;
  shown_pixels(picture.rgb, stops, texture_.edit(picture.width, picture.height));
  in_texture_ = snapshot;
  stops_in_texture_ = stops;
}

void ViewPanel::draw_picture(const Workbench& workbench)
{
  if (!workbench.snapshot() || texture_.empty() || too_large(*workbench.snapshot()->picture)) return;
  const auto size = picture_size(workbench);
  const Placement placement = place(workbench.look(), canvas_, size);
  const ImVec2 from = vec(placement.to_screen({0, 0}));
  const ImVec2 to = vec(placement.to_screen({static_cast<double>(size[0]), static_cast<double>(size[1])}));
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  const bool squares = placement.scale >= pixel_squares_from && platform.DrawCallback_SetSamplerNearest;
  if (squares) draw_list->AddCallback(platform.DrawCallback_SetSamplerNearest, nullptr);
  draw_list->AddImage(texture_.ref(), from, to);
  if (squares) draw_list->AddCallback(platform.DrawCallback_SetSamplerLinear, nullptr);
  draw_list->AddRect({from.x - 1, from.y - 1}, {to.x + 1, to.y + 1}, colour::frame);
}

/// What to do or to wait for while there is no picture to see.
void ViewPanel::draw_hint(const Workbench& workbench) const
{
  std::string hint;
  if (const auto& snapshot = workbench.snapshot()) {
    if (!too_large(*snapshot->picture)) return;
    hint = too_large_hint(*snapshot->picture);
  } else if (!workbench.preset())
    hint = "Drop a preset here, or open one: Ctrl+O";
  else if (workbench.status().state == job::State::failed)
    hint = "No picture: see the message below";
  else if (workbench.status().state == job::State::cancelled)
    hint = "Cancelled before the first picture; start again: F5";
  else
    hint = "Preparing: reading the scene, building the kernels";
  const float wrap = 0.9f * static_cast<float>(canvas_.size[0]);
  const ImVec2 extent = ImGui::CalcTextSize(hint.c_str(), nullptr, false, wrap);
  const ImVec2 middle = vec({canvas_.corner[0] + canvas_.size[0] / 2, canvas_.corner[1] + canvas_.size[1] / 2});
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, {middle.x - extent.x / 2, middle.y - extent.y / 2}, colour::quiet_text, hint.c_str(),
                                      nullptr, wrap);
}

/// Linear values under the cursor in the picture's lower left corner, with the luminance that the preset's white makes of them.
void ViewPanel::draw_pixel_value(const Workbench& workbench) const
{
  const auto& snapshot = workbench.snapshot();
  if (!hovered_ || !snapshot || !workbench.preset()) return;
  const auto size = picture_size(workbench);
  const auto pixel = pixel_at(place(workbench.look(), canvas_, size), size, mouse());
  if (!pixel) return;
  const std::size_t index =
      3 * (static_cast<std::size_t>((*pixel)[1]) * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>((*pixel)[0]));
  const float* rgb = &snapshot->picture->rgb[index];
  // The Y row of linear sRGB to XYZ (IEC 61966-2-1).
  const double luminance = workbench.preset()->white * (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
  const std::string text = fmt::format("({}, {})   R {:.4g}   G {:.4g}   B {:.4g}   Y {:.4g} W/m2/sr", (*pixel)[0], (*pixel)[1], rgb[0],
                                       rgb[1], rgb[2], luminance);
  const float pad = ImGui::GetFontSize() * 0.4f;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const ImVec2 corner = vec({canvas_.corner[0] + pad, canvas_.corner[1] + canvas_.size[1] - extent.y - 3 * pad});
  ImDrawList* draw_list = ImGui::GetWindowDrawList();
  draw_list->AddRectFilled(corner, {corner.x + extent.x + 2 * pad, corner.y + extent.y + 2 * pad}, colour::overlay, pad);
  draw_list->AddText({corner.x + pad, corner.y + pad}, colour::text, text.c_str());
}

void ViewPanel::use_mouse(const Workbench& workbench, Commands& commands)
{
  if (!workbench.preset()) return;
  if (ImGui::IsItemActivated()) start_drag(workbench);
  if (drag_ != Drag::none) continue_drag(workbench, commands);
  if (hovered_ && ImGui::GetIO().MouseWheel != 0) use_wheel(workbench, commands);
}

void ViewPanel::start_drag(const Workbench& workbench)
{
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl)
    drag_ = Drag::move_picture;
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || (ImGui::IsMouseDown(ImGuiMouseButton_Left) && io.KeyShift))
    drag_ = Drag::pan;
  else if (ImGui::IsMouseDown(ImGuiMouseButton_Right))
    drag_ = Drag::dolly;
  else
    drag_ = Drag::orbit;
  drag_from_ = mouse();
  camera_at_start_ = workbench.preset()->scene.camera;
  look_at_start_ = workbench.look();
  ++gesture_;
}

void ViewPanel::continue_drag(const Workbench& workbench, Commands& commands)
{
  const ImVec2 step = ImGui::GetIO().MouseDelta;
  const Point delta{mouse()[0] - drag_from_[0], mouse()[1] - drag_from_[1]};
  if (step.x != 0 || step.y != 0) {
    if (drag_ == Drag::move_picture) {
      Look look = dragged(look_at_start_, canvas_, picture_size(workbench), delta);
      look.exposure_stops = workbench.look().exposure_stops;
      commands.push_back(command::SetLook{look});
    } else
      move_camera(workbench, delta, commands);
  }
  if (ImGui::IsItemActive()) return;
  drag_ = Drag::none;
  commands.push_back(command::EndGesture{});
}

void ViewPanel::move_camera(const Workbench& workbench, const Point& delta, Commands& commands) const
{
  const auto size = picture_size(workbench);
  const double height = place(workbench.look(), canvas_, size).scale * size[1];
  const double across = delta[0] / height, down = delta[1] / height;
  preset::Preset edited = *workbench.preset();
  const char* label = "";
  if (drag_ == Drag::orbit) {
    // The scene follows the mouse: to the right means that the camera goes to the left.
    edited.scene.camera = orbit(camera_at_start_, -orbit_deg_per_height * across, orbit_deg_per_height * down);
    label = "orbit";
  } else if (drag_ == Drag::pan) {
    edited.scene.camera = pan(camera_at_start_, across, down);
    label = "move the camera";
  } else {
    edited.scene.camera = dolly(camera_at_start_, std::exp2(2 * down));
    label = "distance of the camera";
  }
  commands.push_back(command::Edit{label, std::move(edited), gesture_, true});
}

void ViewPanel::use_wheel(const Workbench& workbench, Commands& commands)
{
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) {
    commands.push_back(
        command::SetLook{zoomed(workbench.look(), canvas_, picture_size(workbench), mouse(), std::pow(notch, io.MouseWheel))});
    return;
  }
  const double now = ImGui::GetTime();
  if (last_wheel_s_ < 0 || now - last_wheel_s_ > wheel_gesture_s) ++gesture_;
  last_wheel_s_ = now;
  preset::Preset edited = *workbench.preset();
  edited.scene.camera = dolly(edited.scene.camera, std::pow(notch, -io.MouseWheel));
  commands.push_back(command::Edit{"distance of the camera", std::move(edited), gesture_, false});
}

} // namespace nephroid::ui
