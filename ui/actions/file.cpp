// SPDX-License-Identifier: Apache-2.0
// The menu "File".
#include "ui/actions/table.h"
#include "ui/state/files.h"

namespace nephroid::ui {
namespace {

void save(const Context& c)
{
  if (const std::filesystem::path target = save_target(c.preset()); target.empty())
    ask<Question::save_preset>(c);
  else
    c.push(command::SavePreset{target});
}

} // namespace

std::vector<Action> file_actions()
{
  const char* menu = "File";
  return {
      {menu, "Open...", ctrl | ImGuiKey_O, false, "A preset file, or one of the shipped presets", always, ask<Question::open>},
      {menu, "Open history...", ctrl | shift | ImGuiKey_O, false, "Pin an earlier run by its folder or its history.csv", always,
       ask<Question::open_history>},
      {menu, "Reopen the last session", 0, false, "What the window was at that was closed, or killed, last",
       [](const Context& c) { return c.has_earlier_session; }, push<command::ReopenSession>,
       [](const Context&) { return std::string("there is no earlier session"); }},
      {menu, "Save preset", ctrl | ImGuiKey_S, false, "Write the preset as it is now to its file", has_preset, save},
      {menu, "Save preset as...", ctrl | shift | ImGuiKey_S, false, "Write the preset as it is now to another file", has_preset,
       ask<Question::save_preset>},
      {menu, "Save picture as...", ctrl | ImGuiKey_E, false, "Write the picture as it is now: .png as shown, .exr linear", has_picture,
       ask<Question::save_picture>},
      {menu, "Quit", ctrl | ImGuiKey_Q, false, "Close the window", always, push<command::Quit>},
  };
}

} // namespace nephroid::ui
