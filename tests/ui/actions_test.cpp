// SPDX-License-Identifier: Apache-2.0
// Every action of the table, pressed in every way there is: found by its name in the command palette, by its keys, in its menu, on the
// toolbar. What it shall do is in action_effects.h; an action that is not there fails the test.
#include "action_desk.h"
#include "action_effects.h"

#include <fmt/format.h>

namespace nephroid::ui::actions_test {

using test::Desk;

/// As often as `chosen` says of an action: a new window in which it is possible, press(window, action), and its effect.
template <class Chosen, class Press>
int press_each(Chosen chosen, Press press)
{
  const std::map<std::string, test::Effect> effects = test::action_effects();
  int pressed = 0;
  for (const Action& action : actions()) {
    if (!chosen(action)) continue;
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
    press(desk, action);
    EXPECT_TRUE(desk.comes_to(effect->second.happened));
    ++pressed;
  }
  return pressed;
}

int count(bool (*which)(const Action&))
{
  int found = 0;
  for (const Action& action : actions()) found += which(action);
  return found;
}
bool any(const Action&) { return true; }
bool has_keys(const Action& action) { return action.shortcut != 0; }

/// For docs/window.md.
void say(const char* how, int pressed) { fmt::print("actions {}: {} of {}\n", how, pressed, actions().size()); }

TEST(Actions, NamesAndEffectsAreOneToOne)
{
  std::set<std::string> names;
  for (const Action& action : actions()) EXPECT_TRUE(names.insert(action.name).second) << action.name << " is there twice";
  for (const auto& [name, effect] : test::action_effects()) EXPECT_TRUE(names.contains(name)) << name << " is no action";
}

TEST(Actions, EachIsPressedInThePalette)
{
  const int pressed = press_each(
      any, [](Desk& desk, const Action& action) { EXPECT_TRUE(desk.by_palette(action)) << "its whole name does not find it first"; });
  EXPECT_EQ(pressed, count(any));
  say("pressed in the palette", pressed);
}

// Keys are held while it is looked: what R does ends when it goes up.
TEST(Actions, EachKeyIsPressed)
{
  const int pressed = press_each(has_keys, [](Desk& desk, const Action& action) { desk.hold(action.shortcut); });
  EXPECT_EQ(pressed, count(has_keys));
  say("pressed by their keys", pressed);
}

TEST(Actions, EachEntryOfTheMenusIsClicked)
{
  const int pressed =
      press_each(any, [](Desk& desk, const Action& action) { EXPECT_TRUE(desk.by_menu(action)) << "its menu has no such entry"; });
  EXPECT_EQ(pressed, count(any));
  say("clicked in the menus", pressed);
}

TEST(Actions, EachButtonOfTheToolbarIsClicked)
{
  std::set<std::string> buttons;
  {
    Desk desk;
    for (const Action& action : actions())
      if (desk.workspace.place_of("toolbar:" + action.name)) buttons.insert(action.name);
  }
  const int pressed =
      press_each([&](const Action& action) { return buttons.contains(action.name); },
                 [](Desk& desk, const Action& action) { desk.click(desk.workspace.place_of("toolbar:" + action.name).value()); });
  EXPECT_EQ(pressed, 5);
  say("clicked on the toolbar", pressed);
}

} // namespace nephroid::ui::actions_test
