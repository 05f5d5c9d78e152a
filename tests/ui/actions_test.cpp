// SPDX-License-Identifier: Apache-2.0
// Every action of the table: what it does, which is in action_effects.h, and the ways to it: found by its name in the
// command palette, by its keys, in its menu, on the toolbar. And docs/keys.md, which says what the table does: with the
// folder docs in NEPHROID_PICTURES it is written there.
#include "action_effects.h"

namespace nephroid::ui::actions_test {

/// While it is there, the one action of the table that is possible is `only`, and what is run is noted instead.
class NotedActions {
public:
  NotedActions() : before_(actions().begin(), actions().end()) {
    for (const Action& entry : actions()) {
      Action& action = const_cast<Action&>(entry); // of a vector, whose elements are no constants
      action.enabled = [this, &action](const Context&) { return &action == only; };
      action.run = [this, &action](const Context&) { ran.push_back(action.name); };
      action.why_not = nullptr;
      action.let_go = nullptr;
      action.checked = nullptr;
    }
  }
  ~NotedActions() { std::copy(before_.begin(), before_.end(), const_cast<Action*>(actions().data())); }
  NotedActions(const NotedActions&) = delete;

  const Action* only = nullptr;
  std::vector<std::string> ran;

private:
  std::vector<Action> before_;
};

TEST(Actions, HaveNamesKeysAndEffectsOfTheirOwn) {
  // What is selected goes first, and only then these mean something else (Shortcuts).
  const std::set<int> shared{ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow};
  std::set<int> shortcuts;
  for (const Action& action : actions())
    EXPECT_TRUE(!action.shortcut || shared.contains(action.shortcut) || shortcuts.insert(action.shortcut).second)
        << action.name;
  std::set<std::string> names;
  for (const Action& action : actions())
    EXPECT_TRUE(names.insert(action.name).second) << action.name << " is there twice";
  for (const auto& [name, effect] : action_effects()) EXPECT_TRUE(names.contains(name)) << name << " is no action";
  EXPECT_THROW(action("Fly"), Error);
}

// Each in a new window in which it is possible.
TEST(Actions, EachDoesWhatItShall) {
  const std::map<std::string, Effect> effects = action_effects();
  for (const Action& action : actions()) {
    SCOPED_TRACE(action.menu + ": " + action.name);
    const auto effect = effects.find(action.name);
    if (effect == effects.end()) {
      ADD_FAILURE() << "no effect is expected of it: add it to tests/ui/action_effects.h";
      continue;
    }
    Desk desk;
    if (effect->second.prepare) effect->second.prepare(desk);
    desk.remember();
    EXPECT_FALSE(effect->second.happened(desk)) << "it is so before the action";
    // By its keys, which are still held while it is looked: what R does ends when it goes up.
    if (action.shortcut)
      desk.hold(action.shortcut);
    else
      EXPECT_TRUE(desk.by_menu(action));
    EXPECT_TRUE(desk.comes_to(effect->second.happened));
  }
}

TEST(Actions, EachIsReachedInEveryWay) {
  Desk desk;
  NotedActions noted;
  int on_toolbar = 0, with_keys = 0;
  for (const Action& action : actions()) {
    SCOPED_TRACE(action.menu + ": " + action.name);
    noted.only = &action;
    noted.ran.clear();
    std::vector<std::string> ran;
    const auto expect_ran = [&](const char* how) {
      desk.frames(2);
      ran.push_back(action.name);
      EXPECT_EQ(noted.ran, ran) << how;
      ran = noted.ran;
    };
    EXPECT_TRUE(desk.by_palette(action)) << "its whole name does not find it first";
    expect_ran("in the palette");
    EXPECT_TRUE(desk.by_menu(action)) << "its menu has no such entry";
    expect_ran("in the menu");
    if (action.shortcut) {
      ++with_keys;
      desk.hold(action.shortcut);
      desk.lift(action.shortcut);
      expect_ran("by its keys");
    }
    if (const auto button = desk.workspace.place_of("toolbar:" + action.name)) {
      ++on_toolbar;
      desk.click(*button);
      expect_ran("on the toolbar");
    }
  }
  EXPECT_EQ(on_toolbar, 5);
  fmt::print("{} actions in the palette and in a menu, {} with keys, {} on the toolbar\n", actions().size(), with_keys,
             on_toolbar); // docs/notebook/window.md
}

std::string keys_page() {
  std::string page = "# Mouse and keys of the window\n\n"
                     "This page is made of the program's own table of actions, from which menus and F1 are made too. "
                     "Ctrl+Shift+P lists all actions.\n\n"
                     "|mouse|what it does|\n|---|---|\n";
  for (const MouseHabit& habit : mouse_habits()) page += fmt::format("|{}|{}|\n", habit.how, habit.what);
  std::string menu;
  const std::span<const Action> table = actions();
  for (std::size_t i = 0; i < table.size();) {
    if (table[i].menu != menu)
      page += fmt::format("\n## {}\n\n|action|keys|what it does|\n|---|---|---|\n", table[i].menu);
    menu = table[i].menu;
    std::string names = table[i].name, keys = keys_of(table[i]);
    const std::string& help = table[i].help;
    while (++i < table.size() && table[i].menu == menu && table[i].help == help) { // one row for what is told alike
      names += ", " + table[i].name;
      if (table[i].shortcut) keys += fmt::format(", {}", keys_of(table[i]));
    }
    page += fmt::format("|{}|{}|{}|\n", names, keys, help);
  }
  return page;
}

TEST(KeysPage, IsTheTableOfActions) {
  ImGui::CreateContext(); // it names the keys
  const std::string page = keys_page();
  ImGui::DestroyContext();
  if (const char* docs = std::getenv("NEPHROID_PICTURES")) write_file_whole(fs::path(docs) / "keys.md", page);
  EXPECT_EQ(read_file(fs::path(NEPHROID_SOURCE_DIR) / "docs/keys.md"), page)
      << "write it again: NEPHROID_PICTURES=$PWD/docs build/release/tests/ui/ui_tests --gtest_filter=KeysPage.*";
}

} // namespace nephroid::ui::actions_test
