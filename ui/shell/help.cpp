// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/help.h"

#include "ui/shell/actions.h"
#include "ui/state/workbench.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace nephroid::ui {
namespace {

struct MouseHabit {
  const char* how;
  const char* what;
};

const MouseHabit mouse_habits[] = {
    {"Left drag", "Orbit: the scene turns with the mouse"},
    {"Middle or Shift+left drag", "Pan: move the camera sideways and up"},
    {"Wheel, or right drag", "Distance of the camera"},
    {"Ctrl+wheel", "Zoom the picture about the cursor"},
    {"Ctrl+drag", "Move the picture in the panel"},
    {"Hover", "Linear values and luminance of the pixel"},
    {"Drop a file", "Open that preset; pin a run's folder or history.csv"},
    {"On a plot: wheel, drag, double click", "Zoom, move, show everything"},
};

void row(const char* how, const char* what)
{
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(how);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
}

} // namespace

void draw_help(const Workbench& workbench, Commands& commands)
{
  if (!workbench.help_shown()) return;
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  bool open = true;
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Mouse and keys", &open, flags) && ImGui::BeginTable("help", 2, ImGuiTableFlags_RowBg)) {
    for (const MouseHabit& habit : mouse_habits) row(habit.how, habit.what);
    for (const Action& action : actions())
      if (action.shortcut) row(ImGui::GetKeyChordName(action.shortcut), action.help);
    ImGui::EndTable();
  }
  ImGui::End();
  if (!open) commands.push_back(command::ShowHelp{false});
}

} // namespace nephroid::ui
