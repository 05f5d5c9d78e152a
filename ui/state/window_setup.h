// SPDX-License-Identifier: Apache-2.0
// How a person set up the window: its theme and text size, which panels are open and where, the list of keys.
#pragma once
#include "ui/state/document.h"

#include <algorithm>
#include <string>
#include <utility>

namespace nephroid::ui {

class WindowSetup {
public:
  /// document outlives it.
  explicit WindowSetup(const Document& document) : document_(document) {}

  const Settings& settings() const { return settings_; }
  /// Restores kept settings, before the first frame.
  void set_settings(Settings settings) { settings_ = std::move(settings); }
  bool help_shown() const { return help_shown_; }
  /// True once after ResetLayout.
  bool take_layout_reset() { return std::exchange(layout_reset_, false); }
  /// Returns once after ShowPanel the panel to bring to the front; else empty.
  std::string take_panel_to_front() { return std::exchange(panel_to_front_, {}); }

  void carry_out(const command::ToggleHelp&) { help_shown_ = !help_shown_; }
  void carry_out(const command::KeepLayout& c) { settings_.engines[c.engine].ini = c.ini; }
  void carry_out(const command::ResetLayout&) {
    engine_layout() = {};
    layout_reset_ = true;
  }
  void carry_out(const command::ShowPanel& c) {
    if (c.on) panel_to_front_ = c.name;
    if (!document_.preset()) return; // the start page has no layout
    if (c.on)
      engine_layout().closed.erase(c.name);
    else
      engine_layout().closed.insert(c.name);
  }
  void carry_out(const command::SetAppearance& c) {
    settings_.theme = c.theme;
    settings_.text_size = std::clamp(c.text_size, Settings::smallest_text, Settings::largest_text);
  }

private:
  /// The layout that is kept for the presets of the engine in hand.
  EngineLayout& engine_layout() { return settings_.engines[std::string(document_.preset()->settings.engine())]; }

  const Document& document_;
  Settings settings_;
  std::string panel_to_front_;
  bool help_shown_ = false, layout_reset_ = false;
};

} // namespace nephroid::ui
