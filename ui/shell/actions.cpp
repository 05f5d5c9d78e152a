// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/actions.h"

#include "base/error.h"
#include "measure/history_file.h"
#include "ui/error/panel.h"
#include "ui/state/workbench.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

namespace nephroid::ui {
namespace {

using W = const Workbench&;
using C = Commands&;

bool always(W) { return true; }
bool has_preset(W w) { return w.preset() != nullptr; }
bool has_picture(W w) { return w.snapshot() != nullptr; }
bool can_undo(W w) { return w.history() && !w.history()->undo_label().empty(); }
bool can_redo(W w) { return w.history() && !w.history()->redo_label().empty(); }
bool works(W w)
{
  const job::State state = w.status().state;
  return state == job::State::preparing || state == job::State::running || state == job::State::paused;
}

void ask(C commands, Question question) { commands.push_back(command::Ask{question}); }

void save(W w, C commands)
{
  const std::filesystem::path target = w.save_target();
  if (target.empty())
    ask(commands, Question::save_preset);
  else
    commands.push_back(command::SavePreset{target});
}

void brighten(W w, C commands, double stops)
{
  Look look = w.look();
  look.exposure_stops = stops == 0 ? 0 : look.exposure_stops + stops;
  commands.push_back(command::SetLook{look});
}

void actual_size(W w, C commands)
{
  Look look = w.look();
  const job::Picture& picture = *w.snapshot()->picture;
  look.fit = false;
  look.zoom = 1;
  look.centre = {picture.width / 2.0, picture.height / 2.0};
  commands.push_back(command::SetLook{look});
}

void fit(W w, C commands)
{
  Look look = w.look();
  look.fit = true;
  commands.push_back(command::SetLook{look});
}

void reset_camera(W w, C commands)
{
  preset::Preset edited = *w.preset();
  edited.scene.camera = w.history()->opened().scene.camera;
  commands.push_back(command::Edit{"reset the camera", std::move(edited)});
}

bool has_history(W w) { return w.error_history() != nullptr; }
bool has_plot(W w) { return !shown_metric(w).empty(); }
bool has_plan(W w) { return w.plan() != nullptr; }
// What is on can be turned off, whatever became of the other picture.
bool can_flip(W w) { return w.comparison().flip || w.why_not_comparable().empty(); }
bool can_difference(W w) { return w.comparison().difference || w.why_not_comparable().empty(); }
std::string why_not_comparable(W w) { return w.why_not_comparable(); }
bool has_choice(W w) { return !w.pinned().all().empty(); }
std::string no_choice(W) { return "no run is pinned"; }
std::string not_measured(W) { return "this run is not measured"; }

void flip(W w, C commands) { commands.push_back(command::Flip{!w.comparison().flip}); }
void flip_back(W w, C commands)
{
  if (w.comparison().flip) commands.push_back(command::Flip{false});
}

void difference(W w, C commands)
{
  const Comparison& now = w.comparison();
  commands.push_back(command::ShowDifference{!now.difference, now.metric, now.scale});
}

/// The reference, then each pinned run, and round again.
void compare_with_next(W w, C commands)
{
  const std::vector<PinnedRun>& runs = w.pinned().all();
  const auto next = std::find_if(runs.begin(), runs.end(), [&](const PinnedRun& run) { return run.id > w.comparison().pin; });
  commands.push_back(command::CompareWith{next == runs.end() ? 0 : next->id});
}

constexpr int ctrl = ImGuiMod_Ctrl, shift = ImGuiMod_Shift;

const Action table[] = {
    {"File", "Open...", ctrl | ImGuiKey_O, false, "A preset file, or one of the shipped presets", always,
     [](W, C c) { ask(c, Question::open); }},
    {"File", "Open history...", ctrl | shift | ImGuiKey_O, false, "Pin an earlier run by its folder or its history.csv", always,
     [](W, C c) { ask(c, Question::open_history); }},
    {"File", "Save preset", ctrl | ImGuiKey_S, false, "Write the preset as it is now to its file", has_preset, save},
    {"File", "Save preset as...", ctrl | shift | ImGuiKey_S, false, "Write the preset as it is now to another file", has_preset,
     [](W, C c) { ask(c, Question::save_preset); }},
    {"File", "Save picture as...", ctrl | ImGuiKey_E, false, "Write the picture as it is now: .png as shown, .exr linear", has_picture,
     [](W, C c) { ask(c, Question::save_picture); }},
    {"File", "Quit", ctrl | ImGuiKey_Q, false, "Close the window", always, [](W, C c) { c.push_back(command::Quit{}); }},
    {"Edit", "Undo", ctrl | ImGuiKey_Z, true, "Take back the newest edit of the preset", can_undo,
     [](W, C c) { c.push_back(command::Undo{}); }},
    {"Edit", "Redo", ctrl | shift | ImGuiKey_Z, true, "Do again what was taken back", can_redo,
     [](W, C c) { c.push_back(command::Redo{}); }},
    {"Edit", "Reset camera", ImGuiKey_Home, false, "The camera of the preset as it was opened", has_preset, reset_camera},
    {"Edit", "Copy history as CSV", 0, false, "This run's errors so far, as history.csv has them", has_history,
     [](W w, C) { ImGui::SetClipboardText(measure::to_csv(*w.error_history()).c_str()); }, not_measured},
    {"Edit", "Copy plot as CSV", 0, false, "Every number of the plot of error against time", has_plot,
     [](W w, C) { ImGui::SetClipboardText(plot_as_csv(w).c_str()); }, not_measured},
    {"Edit", "Copy plan as JSON", 0, false, "As a run writes it to plan.json", has_plan,
     [](W w, C) { ImGui::SetClipboardText(plan::to_json(*w.plan()).c_str()); }},
    {"Run", "Start again", ImGuiKey_F5, false, "Start the run from its beginning", has_preset,
     [](W, C c) { c.push_back(command::Restart{}); }},
    {"Run", "Pause", ImGuiKey_Space, false, "Hold the run, or let it go on", works,
     [](W w, C c) { c.push_back(command::Pause{w.status().state != job::State::paused}); }},
    {"Run", "Cancel", ImGuiKey_Escape, false, "End the run; its picture stays", works, [](W, C c) { c.push_back(command::Cancel{}); }},
    {"Run", "Pin this run", ImGuiKey_P, false, "Keep its history and its picture to hold later runs against", has_picture,
     [](W, C c) { c.push_back(command::PinRun{}); }},
    {"View", "Flip", ImGuiKey_R, false, "While held: the reference, or the pinned run that is compared with", can_flip, flip,
     why_not_comparable, flip_back},
    {"View", "Difference", ImGuiKey_D, false, "The difference from it in false colour", can_difference, difference, why_not_comparable},
    {"View", "Compare with the next", ImGuiKey_N, false, "The reference, then each pinned run", has_choice, compare_with_next, no_choice},
    {"View", "Fit", ImGuiKey_F, false, "The whole picture in the panel", has_picture, fit},
    {"View", "Actual size", ImGuiKey_1, false, "One pixel of the picture is one of the screen", has_picture, actual_size},
    {"View", "Brighter", ImGuiKey_E, true, "Half a stop more exposure", always, [](W w, C c) { brighten(w, c, 0.5); }},
    {"View", "Darker", shift | ImGuiKey_E, true, "Half a stop less exposure", always, [](W w, C c) { brighten(w, c, -0.5); }},
    {"View", "Exposure 0", ImGuiKey_0, false, "The picture as image.png shows it", always, [](W w, C c) { brighten(w, c, 0); }},
    {"View", "Reset layout", 0, false, "Every panel back to its place", always, [](W, C c) { c.push_back(command::ResetLayout{}); }},
    {"Help", "Mouse and keys", ImGuiKey_F1, false, "What the mouse and the keys do", always,
     [](W w, C c) { c.push_back(command::ShowHelp{!w.help_shown()}); }},
};

const char* keys(const Action& action) { return action.shortcut ? ImGui::GetKeyChordName(action.shortcut) : ""; }

/// Under the mouse: what it does or, where it is greyed, why.
void tooltip(const Action& action, bool enabled, const Workbench& workbench, bool with_keys)
{
  std::string text = action.help;
  if (with_keys && action.shortcut) text += fmt::format(": {}", keys(action));
  if (!enabled && action.why_not) text += fmt::format(". Not now: {}.", action.why_not(workbench));
  ImGui::SetItemTooltip("%s", text.c_str());
}

void draw_item(const Action& action, const Workbench& workbench, Commands& commands)
{
  const bool enabled = action.enabled(workbench);
  if (ImGui::MenuItem(action.name, keys(action), false, enabled)) action.run(workbench, commands);
  tooltip(action, enabled, workbench, false);
}

/// The key of a chord without its modifiers.
ImGuiKey key_of(int shortcut) { return static_cast<ImGuiKey>(shortcut & ~ImGuiMod_Mask_); }

} // namespace

std::span<const Action> actions() { return table; }

const Action& action(const char* name)
{
  const auto found = std::find_if(std::begin(table), std::end(table), [&](const Action& a) { return std::string_view(a.name) == name; });
  if (found == std::end(table)) throw failed("actions", std::string("there is no action \"") + name + "\"");
  return *found;
}

void action_button(const char* name, const Workbench& workbench, Commands& commands)
{
  const Action& meant = action(name);
  const bool enabled = meant.enabled(workbench);
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button(name)) meant.run(workbench, commands);
  ImGui::EndDisabled();
  tooltip(meant, enabled, workbench, true);
}

void action_item(const char* name, const Workbench& workbench, Commands& commands) { draw_item(action(name), workbench, commands); }

void draw_menus(const Workbench& workbench, Commands& commands)
{
  const char* menu = nullptr;
  bool open = false;
  for (const Action& action : table) {
    if (!menu || std::string_view(menu) != action.menu) {
      if (open) ImGui::EndMenu();
      menu = action.menu;
      open = ImGui::BeginMenu(menu);
    }
    if (open) draw_item(action, workbench, commands);
  }
  if (open) ImGui::EndMenu();
}

void run_shortcuts(const Workbench& workbench, Commands& commands)
{
  const ImGuiIO& io = ImGui::GetIO();
  const bool elsewhere = workbench.question() != Question::none || io.WantTextInput;
  for (const Action& action : table) {
    if (!action.shortcut) continue;
    // A window that loses the keyboard never hears that the key went up.
    if (action.let_go && (ImGui::IsKeyReleased(key_of(action.shortcut)) || io.AppFocusLost)) action.let_go(workbench, commands);
    // Not ImGui::Shortcut: the routes it goes by are those of the frame before, so that a key in the first frame would be lost.
    const ImGuiInputFlags flags = action.repeats ? ImGuiInputFlags_Repeat : ImGuiInputFlags_None;
    if (elsewhere || !ImGui::IsKeyChordPressed(action.shortcut, flags)) continue;
    if (action.enabled(workbench))
      action.run(workbench, commands);
    else if (action.why_not)
      commands.push_back(command::Report{fmt::format("{}: {}", action.name, action.why_not(workbench)), false});
  }
}

} // namespace nephroid::ui
