// SPDX-License-Identifier: Apache-2.0
// The menu "Camera": its bookmarks. Their names are in the View's list "Cameras".
#include "ui/actions/table.h"

#include <fmt/format.h>

namespace nephroid::ui {

std::vector<Action> camera_actions()
{
  const char* menu = "Camera";
  std::vector<Action> all{{menu, "Bookmark this camera", ctrl | ImGuiKey_B, false, "Keep where the camera is, to come back", has_preset,
                           push<command::AddBookmark>}};
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({menu, fmt::format("Go to camera {}", i + 1), ctrl | static_cast<int>(ImGuiKey_1 + i), false,
                   "The camera of the View's list \"Cameras\"",
                   [i](const Context& c) { return c.preset() && i < c.chosen.bookmarks.size(); },
                   [i](const Context& c) { c.push(command::GoToBookmark{i}); },
                   [](const Context& c) { return fmt::format("{} cameras are bookmarked", c.chosen.bookmarks.size()); }});
  return all;
}

} // namespace nephroid::ui
