// SPDX-License-Identifier: Apache-2.0
// Bookmarks of cameras in the whole window: made, gone to, renamed and deleted by keys and mouse.

#include "window_fixture.h"

namespace nephroid::ui::bookmarks_test {

class Bookmarks : public test::WindowFixture {
protected:
  const std::vector<Bookmark>& all() const { return workbench.view_state().bookmarks; }
  void bookmark() { press(ImGuiKey_B, ImGuiMod_Ctrl); }
  void show_list() {
    click(*view().place_of("cameras"));
    frames(2);
  }
};

TEST_F(Bookmarks, KeepACameraToComeBackTo) {
  open();
  const preset::Camera first = camera();
  bookmark();
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0], (Bookmark{"Test 1", first}));
  drag(0, 60, 20);
  const preset::Camera second = camera();
  ASSERT_NE(second, first);
  bookmark();
  ASSERT_EQ(all().size(), 2U);
  EXPECT_EQ(all()[1].name, "Test 2");
  press(ImGuiKey_1, ImGuiMod_Ctrl);
  EXPECT_EQ(camera(), first);
  EXPECT_EQ(workbench.edits()->undo_label(), "go to Test 1");
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(camera(), second);
  press(ImGuiKey_3, ImGuiMod_Ctrl);
  EXPECT_EQ(camera(), second) << "there is no third";
}

TEST_F(Bookmarks, KeepThePicturesSize) {
  open();
  bookmark();
  edit([&](preset::Preset& p) { p.scene.camera.position = {1, 1, 4}, p.scene.camera.resolution = {32, 24}; });
  press(ImGuiKey_1, ImGuiMod_Ctrl);
  EXPECT_EQ(camera().position, (preset::Vec3{0, 0, 4}));
  EXPECT_EQ(camera().resolution, (std::array{32, 24}));
}

TEST_F(Bookmarks, AreInAList) {
  open();
  show_list();
  click(*view().place_of("bookmark"));
  ASSERT_EQ(all().size(), 1U);
  click(middle()); // closes the list
  drag(0, 60, 20);
  const preset::Camera away = camera();
  frames(2);
  show_list();
  click(*view().place_of("name 0"));
  frames(2);
  retype("from the front");
  press(ImGuiKey_Enter);
  EXPECT_EQ(all()[0].name, "from the front");
  click(*view().place_of("go 0"));
  EXPECT_NE(camera(), away);
  EXPECT_EQ(workbench.edits()->undo_label(), "go to from the front");
  show_list();
  click(*view().place_of("delete 0"));
  EXPECT_TRUE(all().empty());
}

TEST_F(Bookmarks, StayWhenAnotherPresetIsOpened) {
  open();
  bookmark();
  ASSERT_TRUE(workbench.open("spectral/prism"));
  frames(3);
  EXPECT_EQ(all().size(), 1U);
  bookmark();
  EXPECT_NE(all()[1].name, all()[0].name);
}

} // namespace nephroid::ui::bookmarks_test
