// SPDX-License-Identifier: Apache-2.0
// The start page under an injected mouse and keys: each card and each button opens what it says, and the keyboard alone does so too.
#include "ui/presets/panel.h"
#include "ui/shell/start_page.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::start_page_test {

class StartPageTest : public test::WindowFixture {
protected:
  StartPageTest()
  {
    ImGui::GetIO().DisplaySize = {1300, 900};
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    runs.steps = 1000000;
    frames(5);
  }
  const PresetsPanel& presets() const { return workspace.panel<PresetsPanel>(); }
  void click(const std::string& widget) { click_in(workspace.start_page(), widget, 3); }
  std::string engine() const { return workbench.preset() ? std::string(workbench.preset()->settings.engine()) : ""; }
  void listed()
  {
    ASSERT_TRUE(test::eventually([&] { frame(); }, [&] { return presets().catalogue().readings() > 0 && workbench.tasks().empty(); }));
    frames(2);
  }
};

class StartPageCard : public StartPageTest, public ::testing::WithParamInterface<std::array<const char*, 3>> {};

TEST_P(StartPageCard, OpensItsExample)
{
  const auto& [card, name, of_engine] = GetParam();
  click(card);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, name);
  EXPECT_EQ(engine(), of_engine);
  for (const Message& message : workbench.messages()) EXPECT_FALSE(message.error) << message.line;
}

INSTANTIATE_TEST_SUITE_P(All, StartPageCard,
                         ::testing::Values(std::array{"first-light", "first-light", "spectral"},
                                           std::array{"environment/ball", "ball", "environment"},
                                           std::array{"inverse/shapes", "shapes", "inverse"}));

TEST_F(StartPageTest, EachButtonDoesWhatItSays)
{
  click("Open...");
  EXPECT_EQ(workbench.question(), Question::open);
  workbench.apply({command::Ask{Question::none}});
  frames(3);
  click("Commands...");
  EXPECT_EQ(workbench.question(), Question::command);
  workbench.apply({command::Ask{Question::none}});
  frames(3);
  click("New scene");
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(engine(), "spectral");
  EXPECT_TRUE(workbench.preset()->source.empty()) << "it is in no file";
  EXPECT_FALSE(workbench.preset()->scene.objects.empty());
}

TEST_F(StartPageTest, AnEarlierSessionIsOfferedWhereThereIsOne)
{
  click("Reopen the last session");
  EXPECT_FALSE(workbench.take_reopen()) << "there is none, and the button is grey";
  workbench.offer_earlier(true);
  frames(2);
  click("Reopen the last session");
  EXPECT_TRUE(workbench.take_reopen());
}

TEST_F(StartPageTest, TypingFindsAPresetWithoutAMouse)
{
  listed();
  type("environment/ball"); // the field has the keyboard from the start
  ASSERT_EQ(presets().listed().size(), 1u);
  press(ImGuiKey_Enter);
  frames(3);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, "ball");
}

TEST_F(StartPageTest, AMessageThatComesTakesTheKeyboardFromNobody)
{
  listed();
  type("environment/");
  workbench.apply({command::Report{"something went wrong"}});
  frames(3);
  type("ball");
  EXPECT_EQ(presets().listed().size(), 1u);
}

// Tab goes from widget to widget, Space presses what is marked: the cards are reached, too.
TEST_F(StartPageTest, TabAndSpaceOpenAnExample)
{
  listed();
  for (int tabs = 0; tabs < 40 && !workbench.preset(); ++tabs) {
    press(ImGuiKey_Tab);
    frames(2);
    const auto card = workspace.start_page().place_of("inverse/shapes");
    const ImRect marked = ImGui::GetCurrentContext()->NavWindow
                              ? ImGui::WindowRectRelToAbs(ImGui::GetCurrentContext()->NavWindow,
                                                          ImGui::GetCurrentContext()->NavWindow->NavRectRel[ImGuiNavLayer_Main])
                              : ImRect();
    if (!card || !marked.Contains(ImVec2(static_cast<float>((*card)[0]), static_cast<float>((*card)[1])))) continue;
    press(ImGuiKey_Space);
    frames(3);
  }
  ASSERT_TRUE(workbench.preset()) << "Tab does not come to the third card";
  EXPECT_EQ(workbench.preset()->name, "shapes");
}

} // namespace nephroid::ui::start_page_test
