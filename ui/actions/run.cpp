// SPDX-License-Identifier: Apache-2.0
// The menu "Run".
#include "engine/engine.h"
#include "ui/actions/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

bool works(C c)
{
  const job::State state = c.run.status().state;
  return state == job::State::preparing || state == job::State::running || state == job::State::paused;
}

bool sweeps(C c) { return c.sweep.active(); }
bool can_restart(C c) { return has_preset(c) && !sweeps(c); }
std::string why_no_restart(C c) { return sweeps(c) ? "the sweep is running" : "no preset is open"; }
bool can_sweep(C c) { return c.edits && !c.edits->sweep().empty() && !sweeps(c); }
std::string why_no_sweep(C c) { return sweeps(c) ? "the sweep is running" : "the preset has no sweep; the panel Runs gives it one"; }

bool has_runs(C c) { return has_picture(c) || !c.comparing.pinned().all().empty(); }

/// An action for each engine whose finished runs have a view of what they found.
void add_result_actions(const char* menu, std::vector<Action>& actions)
{
  for (const engine::Engine* engine : engine::engines()) {
    const engine::ResultView& result = engine->introduction.result;
    if (!result.file) continue;
    actions.push_back({menu, result.action, 0, false,
                       fmt::format("Save what a finished run of the engine {} found in a new folder beside the preset, else in the current "
                                   "one, and open it {}",
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

} // namespace

std::vector<Action> run_actions()
{
  const char* menu = "Run";
  std::vector<Action> actions{
      {menu, "Start again", ImGuiKey_F5, false, "Start the run from its beginning", can_restart, push<command::Restart>, why_no_restart},
      {menu, "Pause", ImGuiKey_Space, false, "Hold the run, or let it go on", works, pause},
      {menu, "Cancel", ImGuiKey_Escape, false, "End the run; its picture stays", works, push<command::Cancel>},
      {menu, "Pin this run", ImGuiKey_P, false, "Keep its history and its picture, to compare later runs with", has_picture,
       push<command::PinRun>},
      {menu, "Start the sweep", 0, false, "Run the preset with each combination of the values that are swept; each result is pinned",
       can_sweep, push<command::StartSweep>, why_no_sweep},
      {menu, "Stop the sweep", 0, false, "What is done stays pinned; the run of the preset starts again", sweeps, push<command::StopSweep>,
       [](C) { return std::string("no sweep is running"); }},
      {menu, "Write a report...", 0, false, "One page over the pinned runs and this one, as nephroid report makes it", has_runs,
       ask<Question::save_report>, [](C) { return std::string("there is no run yet"); }},
  };
  add_result_actions(menu, actions);
  return actions;
}

} // namespace nephroid::ui
