// SPDX-License-Identifier: Apache-2.0
// Camera bookmarks: places to look from, by name. They are the window's, not the preset's.
#pragma once
#include "preset/preset.h"

#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::ui {

struct Bookmark {
  std::string name;
  preset::Camera camera;
  bool operator==(const Bookmark&) const = default;
};

/// "Prism 2": what the preset is called and the first number that no bookmark has with it.
std::string new_bookmark_name(const preset::Preset& preset, const std::vector<Bookmark>& bookmarks);
/// The bookmark's camera with the resolution of another: going somewhere does not change the picture's size.
preset::Camera seen_from(const Bookmark& bookmark, const preset::Camera& now);

} // namespace nephroid::ui
