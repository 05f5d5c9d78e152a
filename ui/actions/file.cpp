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

bool has_file(const Context& c) { return c.preset() && !c.preset()->source.empty(); }
template <NewScene kind>
void begin(const Context& c)
{
  c.push(command::New{kind});
}

} // namespace

std::vector<Action> file_actions()
{
  const char* menu = "File";
  return {
      {menu, "New scene", ctrl | ImGuiKey_N, false, "A glass sphere on a floor under a lamp, to begin with", always,
       begin<NewScene::spectral>},
      {menu, "New scene: environment", 0, false, "A glass sphere under a sky, for the engine environment", always,
       begin<NewScene::environment>},
      {menu, "New scene: inverse", 0, false, "An object that casts two drawings, for the engine inverse", always, begin<NewScene::inverse>},
      {menu, "Open...", ctrl | ImGuiKey_O, false, "A preset file, or one of the shipped presets", always, ask<Question::open>},
      {menu, "Open history...", ctrl | shift | ImGuiKey_O, false, "Pin an earlier run by its folder or its history.csv", always,
       ask<Question::open_history>},
      {menu, "Reopen the last session", 0, false, "The session of the window that was closed or killed last",
       [](const Context& c) { return c.has_earlier_session; }, push<command::ReopenSession>,
       [](const Context&) { return std::string("there is no earlier session"); }},
      {menu, "Save preset", ctrl | ImGuiKey_S, false, "Write the preset as it is now to its file", has_preset, save},
      {menu, "Take the preset from its file", 0, false, "The preset as its file has it now; an edit that can be undone", has_file,
       push<command::ReloadPreset>, [](const Context&) { return std::string("the preset has no file of its own"); }},
      {menu, "Save preset as...", ctrl | shift | ImGuiKey_S, false, "Write the preset as it is now to another file", has_preset,
       ask<Question::save_preset>},
      {menu, "Save picture as...", ctrl | ImGuiKey_E, false, "Write the picture as it is now: .png as shown, .exr linear", has_picture,
       ask<Question::save_picture>},
      {menu, "Quit", ctrl | ImGuiKey_Q, false, "Close the window", always, push<command::Quit>},
  };
}

} // namespace nephroid::ui
