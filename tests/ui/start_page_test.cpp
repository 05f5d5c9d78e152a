// SPDX-License-Identifier: Apache-2.0
// The start page under an injected mouse and keys: each card and each button opens what it says, and the keyboard alone does so too.
#include "ui/presets/panel.h"
#include "ui/shell/start_page.h"
#include "window_fixture.h"

#include <imgui_internal.h>

#include <array>
#include <string>

namespace nephroid::ui {
namespace {

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
  void click(const std::string& widget)
  {
    const auto place = workspace.start_page().place_of(widget);
    ASSERT_TRUE(place) << widget << " is not drawn";
    WindowFixtureOf::click(*place);
    frames(3);
  }
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

TEST_F(StartPageTest, TheListOpensWhatIsClickedTwice)
{
  ImGui::GetIO().DisplaySize = {1300, 1200};
  listed();
  const auto place = presets().place_of("environment/ball");
  ASSERT_TRUE(place);
  WindowFixtureOf::click(*place);
  EXPECT_EQ(workbench.preset(), nullptr);
  WindowFixtureOf::click(*place);
  frames(3);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, "ball");
}

TEST_F(StartPageTest, TypingFindsAPresetWithoutAMouse)
{
  listed();
  ImGui::GetIO().AddInputCharactersUTF8("environment/ball"); // the field has the keyboard from the start
  frames(3);
  ASSERT_EQ(presets().listed().size(), 1u);
  press(ImGuiKey_Enter);
  frames(3);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, "ball");
}

TEST_F(StartPageTest, AMessageThatComesTakesTheKeyboardFromNobody)
{
  listed();
  ImGui::GetIO().AddInputCharactersUTF8("environment/");
  frames(3);
  workbench.apply({command::Report{"something went wrong"}});
  frames(3);
  ImGui::GetIO().AddInputCharactersUTF8("ball");
  frames(3);
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

} // namespace
} // namespace nephroid::ui
