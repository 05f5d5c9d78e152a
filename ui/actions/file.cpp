// SPDX-License-Identifier: Apache-2.0
// The menu "File".
#include "engine/engine.h"
#include "ui/actions/table.h"
#include "ui/state/files.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

void save(C c)
{
  if (const std::filesystem::path target = save_target(c.preset()); target.empty())
    ask<Question::save_preset>(c);
  else
    c.push(command::SavePreset{target});
}

bool has_file(C c) { return c.preset() && !c.preset()->source.empty(); }

/// One an engine. The first engine's is "New scene" itself.
std::vector<Action> new_scene_actions(const char* menu)
{
  std::vector<Action> actions;
  for (const engine::Engine* engine : engine::engines()) {
    const engine::NewScene& scene = engine->introduction.new_scene;
    if (!scene.preset) continue;
    const bool first = actions.empty();
    actions.push_back({menu, first ? "New scene" : fmt::format("New scene: {}", name_of(*engine)), first ? ctrl | ImGuiKey_N : 0, false,
                       fmt::format("{}, for the engine {}", scene.what, name_of(*engine)), always,
                       [preset = scene.preset](C c) { c.push(command::New{preset}); }});
  }
  return actions;
}

} // namespace

std::vector<Action> file_actions()
{
  const char* menu = "File";
  std::vector<Action> actions = new_scene_actions(menu);
  const std::vector<Action> others{
      {menu, "Open...", ctrl | ImGuiKey_O, false, "A preset file, or one of the shipped presets", always, ask<Question::open>},
      {menu, "Open history...", ctrl | shift | ImGuiKey_O, false, "Pin an earlier run by its folder or its history.csv", always,
       ask<Question::open_history>},
      {menu, "Reopen the last session", 0, false, "The session of the window that was closed or killed last",
       [](C c) { return c.has_earlier_session; }, push<command::ReopenSession>,
       [](C) { return std::string("there is no earlier session"); }},
      {menu, "Save preset", ctrl | ImGuiKey_S, false, "Write the preset as it is now to its file", has_preset, save},
      {menu, "Take the preset from its file", 0, false, "The preset as its file has it now; an edit that can be undone", has_file,
       push<command::ReloadPreset>, [](C) { return std::string("the preset has no file of its own"); }},
      {menu, "Save preset as...", ctrl | shift | ImGuiKey_S, false, "Write the preset as it is now to another file", has_preset,
       ask<Question::save_preset>},
      {menu, "Save picture as...", ctrl | ImGuiKey_E, false, "Write the picture as it is now: .png as shown, .exr linear", has_picture,
       ask<Question::save_picture>},
      {menu, "Quit", ctrl | ImGuiKey_Q, false, "Close the window", always, push<command::Quit>},
  };
  actions.insert(actions.end(), others.begin(), others.end());
  return actions;
}

} // namespace nephroid::ui
