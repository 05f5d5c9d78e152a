// SPDX-License-Identifier: Apache-2.0
// How a person set up the window: theme, size of text, which panels are where for each engine. Kept between runs of the program in one
// file.
#pragma once
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace nephroid::ui {

enum class Theme { dark, light };

/// A part of the window: panels as tabs, or two parts beside or above each other.
struct Dock {
  enum class Split { none, columns, rows };
  static constexpr double smallest_part = 0.05;
  Split split = Split::none;
  double first_part = 0.5;            ///< of a split: what the left or upper one takes, from smallest_part to as much less than 1
  std::vector<Dock> parts = {};       ///< of a split: two
  std::vector<std::string> tabs = {}; ///< else: names of panels (shell/panels.h)
  std::string front = {};             ///< the tab that is seen
  bool operator==(const Dock&) const = default;
};

/// A panel in a window of its own, in parts of the program's window.
struct Floating {
  std::string panel;
  std::array<double, 4> place{}; ///< x, y, width, height
  bool operator==(const Floating&) const = default;
};

struct Layout {
  Dock docks;
  std::vector<Floating> floating;
  bool operator==(const Layout&) const = default;
};

/// For the presets of one engine.
struct EngineLayout {
  Layout layout;                ///< without docks: the one that the engine begins with
  std::set<std::string> closed; ///< names of panels
  bool operator==(const EngineLayout&) const = default;
};

struct Settings {
  static constexpr double smallest_text = 0.6, largest_text = 3;

  Theme theme = Theme::dark;
  double text_size = 1;                        ///< times the display's own scale; smallest_text..largest_text
  std::map<std::string, EngineLayout> engines; ///< by an engine's name
  bool operator==(const Settings&) const = default;
};

std::string to_json(const Settings& settings);
/// Throws bad_input at source where the text is no settings, or holds a value that the window cannot have.
Settings parse_settings(const std::string& text, const std::string& source);

} // namespace nephroid::ui
