// SPDX-License-Identifier: Apache-2.0
// The menu "Run".
#include "ui/actions/table.h"

namespace nephroid::ui {
namespace {

bool works(const Context& c)
{
  const job::State state = c.run.status().state;
  return state == job::State::preparing || state == job::State::running || state == job::State::paused;
}

void pause(const Context& c) { c.push(command::Pause{c.run.status().state != job::State::paused}); }

} // namespace

std::vector<Action> run_actions()
{
  const char* menu = "Run";
  return {
      {menu, "Start again", ImGuiKey_F5, false, "Start the run from its beginning", has_preset, push<command::Restart>},
      {menu, "Pause", ImGuiKey_Space, false, "Hold the run, or let it go on", works, pause},
      {menu, "Cancel", ImGuiKey_Escape, false, "End the run; its picture stays", works, push<command::Cancel>},
      {menu, "Pin this run", ImGuiKey_P, false, "Keep its history and its picture to hold later runs against", has_picture,
       push<command::PinRun>},
  };
}

} // namespace nephroid::ui
