// SPDX-License-Identifier: Apache-2.0
// The menu "Edit".
#include "base/error.h"
#include "measure/history_file.h"
#include "preset/differences.h"
#include "ui/actions/table.h"
#include "ui/error/panel.h"
#include "ui/view/camera.h"

namespace nephroid::ui {
namespace {

bool can_undo(C c) { return c.edits && !c.edits->undo_label().empty(); }
bool can_redo(C c) { return c.edits && !c.edits->redo_label().empty(); }
bool has_history(C c) { return c.run.error_history() != nullptr; }
bool has_plot(C c) { return !shown_metric(c).empty(); }
bool has_plan(C c) { return c.run.plan() != nullptr; }
std::string not_measured(C) { return "this run is not measured"; }

void reset_camera(C c)
{
  c.edit("reset the camera", [&](preset::Preset& p) { p.scene.camera = c.edits->opened().scene.camera; });
}

/// What cannot be said is said as a message, at the preset's own place.
void copy_command_line(C c)
{
  try {
    ImGui::SetClipboardText(preset::command_line(*c.preset()).c_str());
    c.note("copied the command line");
  } catch (const Error& error) {
    c.push(command::Report{error.line()});
  }
}

} // namespace

std::vector<Action> edit_actions()
{
  const char* menu = "Edit";
  return {
      {menu, "Undo", ctrl | ImGuiKey_Z, true, "Take back the newest edit of the preset", can_undo, push<command::Undo>},
      {menu, "Redo", ctrl | shift | ImGuiKey_Z, true, "Do again what was taken back", can_redo, push<command::Redo>},
      {menu, "Reset camera", ImGuiKey_Home, false, "The camera of the preset as it was opened", has_preset, reset_camera},
      {menu, "Copy as command line", ctrl | shift | ImGuiKey_C, false, "The command that makes the same run from a shell", has_preset,
       copy_command_line},
      {menu, "Copy history as CSV", 0, false, "This run's errors so far, as history.csv has them", has_history,
       [](C c) { ImGui::SetClipboardText(measure::to_csv(*c.run.error_history()).c_str()); }, not_measured},
      {menu, "Copy plot as CSV", 0, false, "Every number of the plot of error against time", has_plot,
       [](C c) { ImGui::SetClipboardText(plot_as_csv(c).c_str()); }, not_measured},
      {menu, "Copy camera as JSON", 0, false, "The preset's camera, as its file has it", has_preset,
       [](C c) { ImGui::SetClipboardText(camera_json(*c.preset()).c_str()); }},
      {menu, "Copy camera as --set", 0, false, "The preset's camera, as the command line takes it", has_preset,
       [](C c) { ImGui::SetClipboardText(camera_settings(*c.preset()).c_str()); }},
      {menu, "Copy plan as JSON", 0, false, "As a run writes it to plan.json", has_plan,
       [](C c) { ImGui::SetClipboardText(plan::to_json(*c.run.plan()).c_str()); }},
  };
}

} // namespace nephroid::ui
