// SPDX-License-Identifier: Apache-2.0
// What the window is at beside its document: how a person set it up, and which dialog is open.
#pragma once
#include "ui/state/document.h"

#include <algorithm>

namespace nephroid::ui {

/// Theme and text size, which panels are open and where, the list of keys.
class WindowSetup {
public:
  /// document outlives it.
  explicit WindowSetup(const Document& document) : document_(document) {}

  const WindowSettings& settings() const { return settings_; }
  /// Restores kept settings, before the first frame.
  void set_settings(WindowSettings settings) { settings_ = std::move(settings); }
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
    settings_.text_size = std::clamp(c.text_size, WindowSettings::smallest_text, WindowSettings::largest_text);
  }

private:
  /// The layout that is kept for the presets of the engine in hand.
  EngineLayout& engine_layout() { return settings_.engines[std::string(document_.preset()->settings.engine())]; }

  const Document& document_;
  WindowSettings settings_;
  std::string panel_to_front_;
  bool help_shown_ = false, layout_reset_ = false;
};

/// Which dialog is open, and which command waits for its answer: commands that would lose unsaved changes ask first.
class Questions {
public:
  /// document and follow_ups outlive the object.
  Questions(const Document& document, Commands& follow_ups) : document_(document), follow_ups_(follow_ups) {}

  Question question() const { return question_; }
  /// The command that waits with Question::unsaved: an Open, a New, a ReopenSession or a Quit, which asks no more. Else
  /// null.
  const Command* waiting() const { return waiting_ ? &*waiting_ : nullptr; }
  bool quitting() const { return quitting_; }
  /// True once after ReopenSession.
  bool take_reopen() { return std::exchange(reopen_, false); }

  /// Holds the command back until unsaved changes are settled; returns whether it did. The command asks no more then.
  template <class C>
  bool asks_first(C c) {
    if (std::exchange(c.sure, true) || !document_.modified()) return false;
    waiting_ = std::move(c);
    question_ = Question::unsaved;
    return true;
  }
  /// Closes the dialog without an answer; the waiting command is dropped.
  void close() {
    question_ = Question::none;
    waiting_.reset();
  }
  /// The changes are saved: the waiting command is carried out.
  void go_on() {
    if (waiting_) follow_ups_.push_back(std::move(*waiting_));
    close();
  }
  void carry_out(const command::Ask& c) {
    question_ = c.question;
    if (question_ == Question::none) waiting_.reset(); // the answer was "no"
  }
  void carry_out(const command::ReopenSession& c) { reopen_ |= !asks_first(c); }
  void carry_out(const command::Quit& c) { quitting_ |= !asks_first(c); }

private:
  const Document& document_;
  Commands& follow_ups_;
  Question question_ = Question::none;
  std::optional<Command> waiting_;
  bool quitting_ = false, reopen_ = false;
};

} // namespace nephroid::ui
