// SPDX-License-Identifier: Apache-2.0
// What is made of the table of actions: menus, toolbar, shortcuts, the help, the command palette.
#pragma once
#include "ui/widgets/action.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// Draws the menus in the table's order. places, for tests: "menu:NAME", and of open ones "menu:NAME/ACTION".
void draw_menus(const Context& context, WidgetPlaces& places);
/// At the right end of the menu bar: buttons of the actions that are used all day, as far as there is room. places:
/// "toolbar:ACTION".
void draw_toolbar(const Context& context, WidgetPlaces& places);
/// Runs the actions whose keys were pressed.
class Shortcuts {
public:
  /// Says why where an action is not enabled and has a reason. Keys that a text field wants are left to it, all of them
  /// where there is a dialog, and Escape to what is dragged. help: it is shown, and Escape closes it.
  void run(const Context& context, bool dialog, bool help);

private:
  const Action* after_typing_ = nullptr; ///< it runs in the next frame
};

void draw_help(const Context& context);

/// What the mouse does, for the help and for docs/keys.md.
struct MouseHabit {
  const char* how;
  const char* what;
};
std::span<const MouseHabit> mouse_habits();

/// Every action and every shipped preset in one list, found by some of the letters of its name. The keyboard alone is
/// enough: type, up and down, Enter.
class Palette {
public:
  struct Entry {
    std::string name, help, keys;
    const Action* action = nullptr; ///< null: run does it, always
    std::function<void(const Context&)> run;
  };

  /// shown: whether it is open (Question::command).
  void draw(const Context& context, bool shown);
  /// Those that fit what is typed, the best first; for tests.
  const std::vector<const Entry*>& matches() const { return matches_; }

private:
  void begin();
  void search();
  void draw_entries(const Context& context);
  void choose(const Entry& entry, const Context& context) const;

  bool shown_ = false;
  std::string typed_;
  std::vector<Entry> entries_; ///< made when it opens
  std::vector<const Entry*> matches_;
  std::size_t selected_ = 0; ///< an index into matches_
};

} // namespace nephroid::ui
