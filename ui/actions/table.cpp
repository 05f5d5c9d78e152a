// SPDX-License-Identifier: Apache-2.0
// The table, and its small menus: "Camera", whose bookmarks have names in the View's list "Cameras", and "Help".
#include "ui/actions/table.h"

#include "ui/view/bars.h"

#include <fmt/format.h>

namespace nephroid::ui {
namespace {

void bookmark(C c)
{
  std::vector<Bookmark> bookmarks = c.chosen.bookmarks;
  bookmarks.push_back({new_bookmark_name(*c.preset(), bookmarks), c.preset()->scene.camera});
  c.note("bookmarked the camera as \"" + bookmarks.back().name + "\"");
  c.push(command::SetBookmarks{std::move(bookmarks)});
}

std::vector<Action> camera_actions()
{
  const char* menu = "Camera";
  std::vector<Action> all{
      {menu, "Bookmark this camera", ctrl | ImGuiKey_B, false, "Keep where the camera is, to come back", has_preset, bookmark}};
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({menu, fmt::format("Go to camera {}", i + 1), ctrl | static_cast<int>(ImGuiKey_1 + i), false,
                   "The camera of the View's list \"Cameras\"", [i](C c) { return c.preset() && i < c.chosen.bookmarks.size(); },
                   [i](C c) { go_to_bookmark(c, i); },
                   [](C c) { return fmt::format("{} cameras are bookmarked", c.chosen.bookmarks.size()); }});
  return all;
}

std::vector<Action> help_actions()
{
  const char* menu = "Help";
  return {
      {menu, "Commands...", ctrl | shift | ImGuiKey_P, false, "Every action of the window and every preset, by typing some of its letters",
       always, ask<Question::command>},
      {menu, "Mouse and keys", ImGuiKey_F1, false, "What the mouse and the keys do", always, push<command::ToggleHelp>},
  };
}

} // namespace

std::span<const Action> actions()
{
  static const std::vector<Action> table = [] {
    std::vector<Action> all;
    for (const auto& menu : {file_actions(), edit_actions(), select_actions(), camera_actions(), run_actions(), view_actions(),
                             window_actions(), help_actions()})
      all.insert(all.end(), menu.begin(), menu.end());
    return all;
  }();
  return table;
}

} // namespace nephroid::ui
