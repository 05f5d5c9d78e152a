// SPDX-License-Identifier: Apache-2.0
// How a person set up the window: theme, size of text, which panels are where for each engine. Kept between runs of the program in one
// file.
#pragma once
#include <map>
#include <set>
#include <string>

namespace nephroid::ui {

enum class Theme { dark, light };

/// For the presets of one engine.
struct EngineLayout {
  std::string ini;              ///< where the panels are, in Dear ImGui's words; empty: where the engine begins with them
  std::set<std::string> closed; ///< names of panels (shell/panels.h)
  bool operator==(const EngineLayout&) const = default;
};

struct Settings {
  static constexpr double smallest_text = 0.6, largest_text = 3;

  Theme theme = Theme::dark;
  double text_size = 1;                        ///< times the display's own scale; smallest_text..largest_text
  std::map<std::string, EngineLayout> engines; ///< by an engine's name
  bool operator==(const Settings&) const = default;
};

} // namespace nephroid::ui
