// SPDX-License-Identifier: Apache-2.0
// The table of actions, and what is made of it.
#include "ui/shell/menus.h"

#include "measure/history_file.h"
#include "ui/error/panel.h"
#include "ui/state/files.h"
#include "ui/widgets/action.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>

namespace nephroid::ui {
namespace {

using C = const Context&;

bool always(C) { return true; }
bool has_preset(C c) { return c.preset() != nullptr; }
bool has_picture(C c) { return c.run.snapshot() != nullptr; }
bool can_undo(C c) { return c.edits && !c.edits->undo_label().empty(); }
bool can_redo(C c) { return c.edits && !c.edits->redo_label().empty(); }
bool works(C c)
{
  const job::State state = c.run.status().state;
  return state == job::State::preparing || state == job::State::running || state == job::State::paused;
}

/// Pushes a command without arguments.
template <class Pushed>
void push(C c)
{
  c.push(Pushed{});
}

template <Question question>
void ask(C c)
{
  c.push(command::Ask{question});
}

void save(C c)
{
  if (const std::filesystem::path target = save_target(c.preset()); target.empty())
    ask<Question::save_preset>(c);
  else
    c.push(command::SavePreset{target});
}

template <class Change>
void look(C c, Change change)
{
  Look look = c.chosen.look;
  change(look);
  c.push(command::SetLook{look});
}

template <int half_stops>
void expose(C c)
{
  look(c, [](Look& l) { l.exposure_stops += half_stops / 2.0; });
}

void as_it_is(C c)
{
  look(c, [](Look& l) { l.exposure_stops = 0; });
}

void fit(C c)
{
  look(c, [](Look& l) { l.fit = true; });
}

void actual_size(C c)
{
  const job::Picture& picture = *c.run.snapshot()->picture;
  look(c, [&](Look& l) {
    l.fit = false;
    l.zoom = 1;
    l.centre = {picture.width / 2.0, picture.height / 2.0};
  });
}

void reset_camera(C c)
{
  c.edit("reset the camera", [&](preset::Preset& p) { p.scene.camera = c.edits->opened().scene.camera; });
}

bool has_history(C c) { return c.run.error_history() != nullptr; }
bool has_plot(C c) { return !shown_metric(c).empty(); }
bool has_plan(C c) { return c.run.plan() != nullptr; }
// What is on can be turned off, whatever became of the other picture.
bool can_flip(C c) { return c.comparing.comparison().flip || c.comparing.why_not().empty(); }
bool can_difference(C c) { return c.comparing.comparison().difference || c.comparing.why_not().empty(); }
std::string why_not_comparable(C c) { return c.comparing.why_not(); }
bool has_choice(C c) { return !c.comparing.pinned().all().empty(); }
std::string no_choice(C) { return "no run is pinned"; }
std::string not_measured(C) { return "this run is not measured"; }

void flip(C c) { c.push(command::Flip{!c.comparing.comparison().flip}); }
void flip_back(C c)
{
  if (c.comparing.comparison().flip) c.push(command::Flip{false});
}

void difference(C c)
{
  const Comparison& now = c.comparing.comparison();
  c.push(command::ShowDifference{!now.difference, now.metric, now.scale});
}

/// The reference, then each pinned run, and round again.
void compare_with_next(C c)
{
  const std::vector<PinnedRun>& runs = c.comparing.pinned().all();
  const auto next = std::find_if(runs.begin(), runs.end(), [&](const PinnedRun& run) { return run.id > c.comparing.comparison().pin; });
  c.push(command::CompareWith{next == runs.end() ? 0 : next->id});
}

constexpr int ctrl = ImGuiMod_Ctrl, shift = ImGuiMod_Shift;

const Action table[] = {
    {"File", "Open...", ctrl | ImGuiKey_O, false, "A preset file, or one of the shipped presets", always, ask<Question::open>},
    {"File", "Open history...", ctrl | shift | ImGuiKey_O, false, "Pin an earlier run by its folder or its history.csv", always,
     ask<Question::open_history>},
    {"File", "Save preset", ctrl | ImGuiKey_S, false, "Write the preset as it is now to its file", has_preset, save},
    {"File", "Save preset as...", ctrl | shift | ImGuiKey_S, false, "Write the preset as it is now to another file", has_preset,
     ask<Question::save_preset>},
    {"File", "Save picture as...", ctrl | ImGuiKey_E, false, "Write the picture as it is now: .png as shown, .exr linear", has_picture,
     ask<Question::save_picture>},
    {"File", "Quit", ctrl | ImGuiKey_Q, false, "Close the window", always, push<command::Quit>},
    {"Edit", "Undo", ctrl | ImGuiKey_Z, true, "Take back the newest edit of the preset", can_undo, push<command::Undo>},
    {"Edit", "Redo", ctrl | shift | ImGuiKey_Z, true, "Do again what was taken back", can_redo, push<command::Redo>},
    {"Edit", "Reset camera", ImGuiKey_Home, false, "The camera of the preset as it was opened", has_preset, reset_camera},
    {"Edit", "Copy history as CSV", 0, false, "This run's errors so far, as history.csv has them", has_history,
     [](C c) { ImGui::SetClipboardText(measure::to_csv(*c.run.error_history()).c_str()); }, not_measured},
    {"Edit", "Copy plot as CSV", 0, false, "Every number of the plot of error against time", has_plot,
     [](C c) { ImGui::SetClipboardText(plot_as_csv(c).c_str()); }, not_measured},
    {"Edit", "Copy plan as JSON", 0, false, "As a run writes it to plan.json", has_plan,
     [](C c) { ImGui::SetClipboardText(plan::to_json(*c.run.plan()).c_str()); }},
    {"Run", "Start again", ImGuiKey_F5, false, "Start the run from its beginning", has_preset, push<command::Restart>},
    {"Run", "Pause", ImGuiKey_Space, false, "Hold the run, or let it go on", works,
     [](C c) { c.push(command::Pause{c.run.status().state != job::State::paused}); }},
    {"Run", "Cancel", ImGuiKey_Escape, false, "End the run; its picture stays", works, push<command::Cancel>},
    {"Run", "Pin this run", ImGuiKey_P, false, "Keep its history and its picture to hold later runs against", has_picture,
     push<command::PinRun>},
    {"View", "Flip", ImGuiKey_R, false, "While held: the reference, or the pinned run that is compared with", can_flip, flip,
     why_not_comparable, flip_back},
    {"View", "Difference", ImGuiKey_D, false, "The difference from it in false colour", can_difference, difference, why_not_comparable},
    {"View", "Compare with the next", ImGuiKey_N, false, "The reference, then each pinned run", has_choice, compare_with_next, no_choice},
    {"View", "Fit", ImGuiKey_F, false, "The whole picture in the panel", has_picture, fit},
    {"View", "Actual size", ImGuiKey_1, false, "One pixel of the picture is one of the screen", has_picture, actual_size},
    {"View", "Brighter", ImGuiKey_E, true, "Half a stop more exposure", always, expose<1>},
    {"View", "Darker", shift | ImGuiKey_E, true, "Half a stop less exposure", always, expose<-1>},
    {"View", "Exposure 0", ImGuiKey_0, false, "The picture as image.png shows it", always, as_it_is},
    {"View", "Reset layout", 0, false, "Every panel back to its place", always, push<command::ResetLayout>},
    {"Help", "Mouse and keys", ImGuiKey_F1, false, "What the mouse and the keys do", always, push<command::ToggleHelp>},
};

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

/// The key of a chord without its modifiers.
ImGuiKey key_of(int shortcut) { return static_cast<ImGuiKey>(shortcut & ~ImGuiMod_Mask_); }

} // namespace

std::span<const Action> actions() { return table; }

void draw_menus(const Context& context)
{
  const char* menu = nullptr;
  bool open = false;
  for (const Action& action : actions()) {
    if (!menu || std::string_view(menu) != action.menu) {
      if (open) ImGui::EndMenu();
      menu = action.menu;
      open = ImGui::BeginMenu(menu);
    }
    if (open) action_item(action, context);
  }
  if (open) ImGui::EndMenu();
}

void run_shortcuts(const Context& context, bool dialog)
{
  const ImGuiIO& io = ImGui::GetIO();
  const bool elsewhere = dialog || io.WantTextInput;
  for (const Action& action : actions()) {
    if (!action.shortcut) continue;
    // A window that loses the keyboard never hears that the key went up.
    if (action.let_go && (ImGui::IsKeyReleased(key_of(action.shortcut)) || io.AppFocusLost)) action.let_go(context);
    // Not ImGui::Shortcut: the routes it goes by are those of the frame before, so that a key in the first frame would be lost.
    const ImGuiInputFlags flags = action.repeats ? ImGuiInputFlags_Repeat : ImGuiInputFlags_None;
    if (elsewhere || !ImGui::IsKeyChordPressed(action.shortcut, flags)) continue;
    if (action.enabled(context))
      action.run(context);
    else if (action.why_not)
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
    for (const MouseHabit& habit : mouse_habits) row(habit.how, habit.what);
    for (const Action& action : actions())
      if (action.shortcut) row(keys_of(action), action.help);
    ImGui::EndTable();
  }
  ImGui::End();
  if (!open) context.push(command::ToggleHelp{});
}

} // namespace nephroid::ui
