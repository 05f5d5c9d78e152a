// SPDX-License-Identifier: Apache-2.0
#include "ui/state/bookmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace nephroid::ui {

std::string new_bookmark_name(const preset::Preset& preset, const std::vector<Bookmark>& bookmarks)
{
  std::string of = preset.name.empty() ? std::filesystem::path(preset.source).stem().string() : preset.name;
  if (of.empty()) of = "Camera";
  for (int number = 1;; ++number) {
    std::string name = fmt::format("{} {}", of, number);
    if (std::ranges::none_of(bookmarks, [&](const Bookmark& bookmark) { return bookmark.name == name; })) return name;
  }
}

preset::Camera seen_from(const Bookmark& bookmark, const preset::Camera& now)
{
  preset::Camera camera = bookmark.camera;
  camera.resolution = now.resolution;
  return camera;
}

} // namespace nephroid::ui
