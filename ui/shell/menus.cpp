// SPDX-License-Identifier: Apache-2.0
// What is made of the table of actions.
#include "ui/shell/menus.h"

#include "ui/widgets/action.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace nephroid::ui {
namespace {

void row(const char* how, const char* what)
{
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(how);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
}

/// The key of a chord without its modifiers.
ImGuiKey key_of(int shortcut) { return static_cast<ImGuiKey>(shortcut & ~ImGuiMod_Mask_); }

} // namespace

std::span<const MouseHabit> mouse_habits()
{
  static const MouseHabit habits[] = {
      {"Click", "Select the object or light that is there, or nothing"},
      {"Left drag on a handle", "Move, turn or scale what is selected; Ctrl: in steps, or freely with Snap"},
      {"Left drag", "Orbit: the scene turns with the mouse"},
      {"Middle or Shift+left drag", "Pan: move the camera sideways and up"},
      {"Wheel, or right drag", "Distance of the camera"},
      {"Ctrl+wheel", "Zoom the picture about the cursor"},
      {"Ctrl+drag", "Move the picture in the panel"},
      {"Alt+click, Alt+drag", "Inspect a pixel; statistics of a rectangle"},
      {"Hover", "Linear values and luminance of the pixel"},
      {"Drop a preset or a glTF file", "Open it; a glTF file becomes a preset first"},
      {"Drop a run's folder or a history.csv", "Pin that run"},
      {"Drop a mesh (.obj, .ply, .stl)", "Make it an object of the scene"},
      {"Drop a map (.hdr, .exr)", "Put it in place of the environment"},
      {"Drop a picture (.png, .jpg, .tif)", "Engine inverse: the object casts it, in place of the first drawing"},
      {"Drop a dispersion file (.yml)", "Load it into the glass of the panel Dispersion"},
      {"On a plot: wheel, drag, double click", "Zoom, move, show everything"},
  };
  return habits;
}

void draw_menus(const Context& context, WidgetPlaces& places)
{
  std::string menu;
  bool open = false;
  for (const Action& action : actions()) {
    if (menu != action.menu) {
      if (open) ImGui::EndMenu();
      menu = action.menu;
      open = ImGui::BeginMenu(menu.c_str());
      if (!open) places.note("menu:" + menu);
    }
    if (!open) continue;
    action_item(action, context);
    places.note("menu:" + menu + "/" + action.name);
  }
  if (open) ImGui::EndMenu();
}

void draw_toolbar(const Context& context, WidgetPlaces& places)
{
  constexpr const char* names[] = {"Undo", "Redo", "Start again", "Pin this run", "Commands..."};
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = style.WindowPadding.x;
  for (const char* name : names) width += ImGui::CalcTextSize(name).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
  const float left = ImGui::GetWindowWidth() - width;
  if (left < ImGui::GetCursorPosX()) return; // a narrow window has its menus
  ImGui::SetCursorPosX(left);
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
  for (const char* name : names) {
    action_button(name, context);
    places.note("toolbar:" + std::string(name));
  }
  ImGui::PopStyleColor();
}

void run_shortcuts(const Context& context, bool dialog, bool help)
{
  const ImGuiIO& io = ImGui::GetIO();
  const bool elsewhere = dialog || io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup); // an open list has the keyboard
  int taken = 0; // of actions with the same keys the first that is enabled has them
  if (help && !elsewhere && ImGui::IsKeyChordPressed(ImGuiKey_Escape)) {
    context.push(command::ToggleHelp{});
    taken = ImGuiKey_Escape;
  }
  for (const Action& action : actions()) {
    if (!action.shortcut) continue;
    // A window that loses the keyboard never hears that the key went up.
    if (action.let_go && (ImGui::IsKeyReleased(key_of(action.shortcut)) || io.AppFocusLost)) action.let_go(context);
    // Not ImGui::Shortcut: the routes it goes by are those of the frame before, so that a key in the first frame would be lost.
    const ImGuiInputFlags flags = action.repeats ? ImGuiInputFlags_Repeat : ImGuiInputFlags_None;
    // Where somebody goes from widget to widget by the keyboard, Space is for the widget that is marked.
    if (io.NavVisible && action.shortcut == ImGuiKey_Space) continue;
    if (elsewhere || action.shortcut == taken || !ImGui::IsKeyChordPressed(action.shortcut, flags)) continue;
    if (action.enabled(context)) {
      action.run(context);
      taken = action.shortcut;
    } else if (action.why_not)
      context.note(fmt::format("{}: {}", action.name, action.why_not(context)));
  }
}

void draw_help(const Context& context)
{
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  bool open = true;
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Mouse and keys", &open, flags) && ImGui::BeginTable("help", 2, ImGuiTableFlags_RowBg)) {
    for (const MouseHabit& habit : mouse_habits()) row(habit.how, habit.what);
    for (const Action& action : actions())
      if (action.shortcut) row(keys_of(action), action.help.c_str());
    ImGui::EndTable();
  }
  ImGui::End();
  if (!open) context.push(command::ToggleHelp{});
}

} // namespace nephroid::ui
