// SPDX-License-Identifier: Apache-2.0
// The table, with all menus but those that have files of their own: "Add", "Select", "Animation", "View" and
// "Pictures".
#include "ui/actions/table.h"

#include "base/error.h"
#include "engine/engine.h"
#include "measure/run_files.h"
#include "preset/differences.h"
#include "ui/error/panel.h"
#include "ui/shell/panels.h"
#include "ui/view/bars.h"
#include "ui/view/pinhole.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

void save(C c) {
  if (const std::filesystem::path target = save_target(c.preset()); target.empty())
    ask<Question::save_preset>(c);
  else
    c.push(command::SavePreset{target});
}

bool has_file(C c) { return c.preset() && !c.preset()->source.empty(); }

/// One an engine. The first engine's is "New scene" itself.
std::vector<Action> new_scene_actions() {
  std::vector<Action> actions;
  for (const engine::Engine* engine : engine::engines()) {
    const engine::NewScene& scene = engine->introduction.new_scene;
    if (!scene.preset) continue;
    const bool first = actions.empty();
    actions.push_back({first ? "New scene" : fmt::format("New scene: {}", name_of(*engine)),
                       first ? ctrl | ImGuiKey_N : 0,
                       fmt::format("{}, for the engine {}", scene.what, name_of(*engine)), always,
                       [preset = scene.preset](C c) { c.push(command::New{preset}); }});
  }
  actions.push_back({"New scene: empty", 0, "Nothing but a camera", always, [](C c) {
                       c.push(command::New{fmt::format(R"({{"name": "untitled", "engine": "{}", "unit": "m"}})",
                                                       name_of(*engine::engines().front()))});
                     }});
  return actions;
}

std::vector<Action> file_actions() {
  std::vector<Action> actions = new_scene_actions();
  const std::vector<Action> others{
      {"Open...", ctrl | ImGuiKey_O, "A preset file or scene, or a shipped preset", always, ask<Question::open>},
      {"Open history...", ctrl | shift | ImGuiKey_O, "Pin an earlier run by its folder or its history.csv", always,
       ask<Question::open_history>},
      {"Open pictures...", 0, "Pictures of any program (.exr, .hdr, .png, ...), to look at and to compare", always,
       ask<Question::open_pictures>},
      {"Open map...", 0, "A latitude-longitude picture (.hdr, .exr) in place of the environment", has_things,
       ask<Question::open_map>, why_no_things},
      {"Reopen the last session", 0, "The session of the window that was closed or killed last",
       [](C c) { return c.has_earlier_session; }, push<command::ReopenSession>,
       [](C) { return std::string("there is no earlier session"); }},
      ending_typing({"Save preset", ctrl | ImGuiKey_S, "Write the preset as it is now to its file", has_preset, save}),
      {"Take the preset from its file", 0, "The preset as its file has it now; an edit that can be undone", has_file,
       push<command::ReloadPreset>, [](C) { return std::string("the preset has no file of its own"); }},
      ending_typing({"Save preset as...", ctrl | shift | ImGuiKey_S, "Write the preset as it is now to another file",
                     has_preset, ask<Question::save_preset>}),
      {"Save picture as...", ctrl | ImGuiKey_E, "Write the picture as it is now: .png as shown, .exr linear",
       has_picture, ask<Question::save_picture>},
      {"Quit", ctrl | ImGuiKey_Q, "Close the window", always, push<command::Quit>},
  };
  actions.insert(actions.end(), others.begin(), others.end());
  return actions;
}

bool can_undo(C c) { return c.edits && !c.edits->undo_label().empty(); }
bool can_redo(C c) { return c.edits && !c.edits->redo_label().empty(); }
bool has_history(C c) { return c.run.error_history() != nullptr; }
bool has_plot(C c) { return !shown_metric(c).empty(); }
bool has_plan(C c) { return c.run.plan() != nullptr; }
std::string not_measured(C) { return "this run is not measured"; }

void reset_camera(C c) {
  c.edit("reset the camera", [&](preset::Preset& p) { p.scene.camera = c.edits->opened().scene.camera; });
}

/// What cannot be said is said as a message, at the preset's own place.
void copy_command_line(C c) {
  try {
    ImGui::SetClipboardText(preset::command_line(*c.edits->in_file()).c_str());
    c.note("copied the command line");
  } catch (const Error& error) {
    c.push(command::Report{error.line()});
  }
}

std::vector<Action> edit_actions() {
  return {
      repeating({"Undo", ctrl | ImGuiKey_Z, "Take back the newest edit of the preset", can_undo, push<command::Undo>}),
      repeating({"Redo", ctrl | shift | ImGuiKey_Z, "Do again what was taken back", can_redo, push<command::Redo>}),
      {"Reset camera", ImGuiKey_Home, "The camera of the preset as it was opened", has_preset, reset_camera},
      {"Copy as command line", ctrl | shift | ImGuiKey_C, "The command that makes the same run from a shell",
       has_preset, copy_command_line},
      {"Copy history as CSV", 0, "This run's errors so far, as history.csv has them", has_history,
       [](C c) { ImGui::SetClipboardText(measure::to_csv(*c.run.error_history()).c_str()); }, not_measured},
      {"Copy plot as CSV", 0, "Every number of the plot of error against time", has_plot,
       [](C c) { ImGui::SetClipboardText(plot_as_csv(c).c_str()); }, not_measured},
      {"Copy camera as JSON", 0, "The preset's camera, as its file has it", has_preset,
       [](C c) { ImGui::SetClipboardText(camera_json(*c.preset()).c_str()); }},
      {"Copy camera as --set", 0, "The preset's camera, as the command line takes it", has_preset,
       [](C c) { ImGui::SetClipboardText(camera_settings(*c.preset()).c_str()); }},
      {"Copy plan as JSON", 0, "As a run writes it to plan.json", has_plan,
       [](C c) { ImGui::SetClipboardText(plan::to_json(*c.run.plan()).c_str()); }},
  };
}

bool works(C c) {
  const job::State state = c.run.status().state;
  return state == job::State::preparing || state == job::State::running || state == job::State::paused;
}

bool sweeps(C c) { return c.sweep.active(); }
bool can_restart(C c) { return has_preset(c) && !sweeps(c); }
std::string why_no_restart(C c) { return sweeps(c) ? "the sweep is running" : "no preset is open"; }
bool can_sweep(C c) { return c.edits && !c.edits->sweep().empty() && !sweeps(c); }
std::string why_no_sweep(C c) {
  return sweeps(c) ? "the sweep is running" : "the preset has no sweep; the panel Runs gives it one";
}

bool has_runs(C c) { return has_picture(c) || !c.comparing.pinned().all().empty(); }

/// An action for each engine whose finished runs have a view of what they found.
void add_result_actions(std::vector<Action>& actions) {
  for (const engine::Engine* engine : engine::engines()) {
    const engine::ResultView& result = engine->introduction.result;
    if (!result.file) continue;
    actions.push_back(
        {result.action, 0,
         fmt::format(
             "Save what a finished run of the engine {} found in a new folder beside the preset, and open it {}",
             name_of(*engine), result.what),
         [file = result.file](C c) {
           return has_picture(c) && c.run.snapshot_is_current() &&
                  std::ranges::count(c.run.snapshot()->files, file, &job::ExtraFile::name) > 0;
         },
         [file = result.file](C c) { c.push(command::OpenResult{file}); },
         [engine](C) { return fmt::format("there is no finished run of the engine {}", name_of(*engine)); }});
  }
}

void pause(C c) { c.push(command::Pause{c.run.status().state != job::State::paused}); }

std::vector<Action> run_actions() {
  std::vector<Action> actions{
      ending_typing({"Start again", ImGuiKey_F5, "Start the run from its beginning", can_restart,
                     push<command::Restart>, why_no_restart}),
      {"Pause", ImGuiKey_Space, "Hold the run, or let it go on", works, pause},
      {"Cancel", shift | ImGuiKey_F5, "End the run; its picture stays", works, push<command::Cancel>},
      {"Pin this run", ImGuiKey_P, "Keep its history and its picture, to compare later runs with", has_picture,
       push<command::PinRun>},
      {"Start the sweep", 0, "Run the preset with each combination of the swept values; each result is pinned",
       can_sweep, push<command::StartSweep>, why_no_sweep},
      {"Stop the sweep", 0, "What is done stays pinned; the run of the preset starts again", sweeps,
       push<command::StopSweep>, [](C) { return std::string("no sweep is running"); }},
      {"Write a report...", 0, "One page over the pinned runs and this one, as nephroid report makes it", has_runs,
       ask<Question::save_report>, [](C) { return std::string("there is no run yet"); }},
  };
  add_result_actions(actions);
  return actions;
}

/// Opens the panel or brings it to the front; closes it where it is seen.
Action panel_action(const PanelEntry& entry) {
  const auto pressed = [entry](C c) {
    c.push(command::ShowPanel{std::string(entry.name), !can_close(entry) || !is_open(entry, c) || !is_seen(entry)});
  };
  const auto serves_it = [entry](C c) { return c.preset() && serves(entry, *c.preset()); };
  return {fmt::format("Panel: {}", entry.title),
          0,
          can_close(entry) ? "Open this panel or bring it to the front; close it where it is seen"
                           : "Bring the picture to the front",
          serves_it,
          pressed,
          [](C c) { return std::string(c.preset() ? "it has nothing to show of this preset" : "no preset is open"); },
          nullptr,
          [serves_it, entry](C c) { return serves_it(c) && is_open(entry, c); }};
}

constexpr double text_step = 1.1;

void set_appearance(C c, Theme theme, double text_size) { c.push(command::SetAppearance{theme, text_size}); }
bool is_light(C c) { return c.settings.theme == Theme::light; }

std::vector<Action> window_actions() {
  std::vector<Action> all;
  for (const PanelEntry& entry : panel_table()) all.push_back(panel_action(entry));
  all.insert(
      all.end(),
      {{"Reset layout", 0, "Every panel of this engine open and in its place", has_preset, push<command::ResetLayout>},
       {"Light theme", 0, "Dark words on light panels, or the other way round; pictures stay on a dark ground", always,
        [](C c) { set_appearance(c, is_light(c) ? Theme::dark : Theme::light, c.settings.text_size); }, nullptr,
        nullptr, is_light},
       repeating({"Larger text", ctrl | ImGuiKey_Equal, "Everything in the window a tenth larger", always,
                  [](C c) { set_appearance(c, c.settings.theme, c.settings.text_size * text_step); }}),
       repeating({"Smaller text", ctrl | ImGuiKey_Minus, "Everything in the window a tenth smaller", always,
                  [](C c) { set_appearance(c, c.settings.theme, c.settings.text_size / text_step); }}),
       {"Text as the display has it", ctrl | ImGuiKey_0, "The size of text that the display asks for", always,
        [](C c) { set_appearance(c, c.settings.theme, 1); }}});
  return all;
}

void bookmark(C c) {
  std::vector<Bookmark> bookmarks = c.view_state.bookmarks;
  bookmarks.push_back({new_bookmark_name(*c.preset(), bookmarks), c.preset()->scene.camera});
  c.note("bookmarked the camera as \"" + bookmarks.back().name + "\"");
  c.push(command::SetBookmarks{std::move(bookmarks)});
}

std::vector<Action> camera_actions() {
  std::vector<Action> all{
      {"Bookmark this camera", ctrl | ImGuiKey_B, "Keep where the camera is, to come back", has_preset, bookmark}};
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({fmt::format("Go to camera {}", i + 1), ctrl | static_cast<int>(ImGuiKey_1 + i),
                   "The camera of the View's list \"Cameras\"",
                   [i](C c) { return c.preset() && i < c.view_state.bookmarks.size(); },
                   [i](C c) { go_to_bookmark(c, i); },
                   [](C c) { return fmt::format("{} cameras are bookmarked", c.view_state.bookmarks.size()); }});
  return all;
}

std::vector<Action> help_actions() {
  return {
      {"Commands...", ctrl | shift | ImGuiKey_P,
       "Every action of the window and every preset, by typing some of its letters", always, ask<Question::command>},
      {"Mouse and keys", ImGuiKey_F1, "What the mouse and the keys do", always, push<command::ToggleHelp>},
  };
}

} // namespace

std::span<const Action> actions() {
  static const std::vector<Action> table = [] {
    std::vector<Action> actions;
    const auto add = [&](const char* menu, const std::vector<Action>& of_menu) {
      for (const Action& action : of_menu) actions.emplace_back(action).menu = menu;
    };
    add("File", file_actions());
    add("Edit", edit_actions());
    add("Add", add_actions());
    add("Select", select_actions());
    add("Camera", camera_actions());
    add("Animation", animation_actions());
    add("Run", run_actions());
    add("View", view_actions());
    add("Pictures", picture_actions());
    add("Window", window_actions());
    add("Help", help_actions());
    return actions;
  }();
  return table;
}

} // namespace nephroid::ui
