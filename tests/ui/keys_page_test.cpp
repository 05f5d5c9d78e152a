// SPDX-License-Identifier: Apache-2.0
// docs/keys.md is what the table of actions says. With the folder docs in NEPHROID_PICTURES the page is written there.
#include "base/files.h"
#include "tests/support/test.h"
#include "ui/shell/menus.h"
#include "ui/widgets/action.h"

#include <imgui.h>

namespace nephroid::ui::keys_page_test {

std::string keys_page()
{
  std::string page =
      "# Mouse and keys of the window\n\n"
      "This page is made of the program's own table of actions, from which menus and F1 are made too. Ctrl+Shift+P lists all actions.\n\n"
      "|mouse|what it does|\n|---|---|\n";
  for (const MouseHabit& habit : mouse_habits()) page += fmt::format("|{}|{}|\n", habit.how, habit.what);
  std::string menu;
  const std::span<const Action> table = actions();
  for (std::size_t i = 0; i < table.size();) {
    if (table[i].menu != menu) page += fmt::format("\n## {}\n\n|action|keys|what it does|\n|---|---|---|\n", table[i].menu);
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

TEST(KeysPage, IsTheTableOfActions)
{
  ImGui::CreateContext(); // it names the keys
  const std::string page = keys_page();
  ImGui::DestroyContext();
  if (const char* docs = std::getenv("NEPHROID_PICTURES")) write_file_whole(std::filesystem::path(docs) / "keys.md", page);
  EXPECT_EQ(read_file(std::filesystem::path(NEPHROID_SOURCE_DIR) / "docs/keys.md"), page)
      << "write it again: NEPHROID_PICTURES=$PWD/docs build/release/tests/ui/ui_tests --gtest_filter=KeysPage.*";
}

} // namespace nephroid::ui::keys_page_test
