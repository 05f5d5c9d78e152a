// SPDX-License-Identifier: Apache-2.0
// Keys and clicks with modifiers that all arrive between two frames.
#include "headless.h"
#include "tests/support/test.h"
#include "ui/shell/glfw_window.h"

namespace nephroid::ui::input_events_test {

class InputEventsTest : public ::testing::Test {
protected:
  InputEventsTest() { ImGui::GetIO().ConfigInputTrickleEventQueue = true; } // as in the window
  void key(ImGuiKey which, ImGuiKey modifier, bool down)
  {
    imgui_.key(modifier, down);
    imgui_.key(which, down);
  }
  void ctrl(bool down) { key(ImGuiKey_LeftCtrl, static_cast<ImGuiKey>(ImGuiMod_Ctrl), down); }
  /// In how many frames of some more it was so.
  static int frames_with(const std::function<bool()>& condition)
  {
    int found = 0;
    for (int i = 0; i < 6; ++i) {
      new_frame();
      found += condition();
      ImGui::Render();
    }
    return found;
  }
  test::Headless imgui_;
};

TEST_F(InputEventsTest, AChordIsSeenThoughItsModifierWasLetGoFirst)
{
  for (const bool in_one_frame : {true, false}) {
    ctrl(true);
    if (!in_one_frame) frames_with([] { return false; });
    imgui_.key(ImGuiKey_Z, true);
    ctrl(false);
    imgui_.key(ImGuiKey_Z, false);
    EXPECT_EQ(frames_with([] { return ImGui::IsKeyChordPressed(ImGuiMod_Ctrl | ImGuiKey_Z); }), 1);
    EXPECT_EQ(ImGui::GetIO().KeyMods, ImGuiMod_None);
    EXPECT_FALSE(ImGui::IsKeyDown(ImGuiKey_Z));
  }
}

TEST_F(InputEventsTest, AModifierThatIsPressedAgainAtOnceStaysPressed)
{
  ctrl(true);
  frames_with([] { return false; });
  imgui_.key(ImGuiKey_Z, true);
  ctrl(false);
  new_frame();
  ImGui::Render();
  ctrl(true);
  frames_with([] { return false; });
  EXPECT_EQ(ImGui::GetIO().KeyMods, ImGuiMod_Ctrl);
}

TEST_F(InputEventsTest, ATurnOfTheWheelHasTheModifierThatWasHeld)
{
  ctrl(true);
  frames_with([] { return false; });
  imgui_.wheel(1);
  ctrl(false);
  EXPECT_EQ(frames_with([] { return ImGui::GetIO().MouseWheel != 0 && ImGui::GetIO().KeyCtrl; }), 1);
}

TEST_F(InputEventsTest, AClickHasTheModifierThatWasHeld)
{
  ctrl(true);
  frames_with([] { return false; });
  imgui_.button(0, true);
  ctrl(false);
  imgui_.button(0, false);
  EXPECT_EQ(frames_with([] { return ImGui::IsMouseClicked(0) && ImGui::GetIO().KeyCtrl; }), 1);
}

} // namespace nephroid::ui::input_events_test
