// SPDX-License-Identifier: Apache-2.0
// The panel "Plan": what is left out can be computed all the same by a click, which is an edit of the preset.
#include "spectral/settings.h"
#include "window_fixture.h"

namespace nephroid::ui::plan_panel_test {

class PlanPanelTest : public test::WindowFixture {
protected:
  PlanPanelTest() : test::WindowFixture("plan") {
    runs.plan.engine = "spectral";
    runs.plan.decisions = {{"direct", true, "1 diffuse object", "/spectral/direct", true},
                           {"mirrors", false, "no object is a mirror", "/leave_out", false},
                           {"indirect", false, "not rendered yet", "", false},
                           {"walls", false, "in one plane", "/spectral/indirect", true},
                           {"fog", false, "there is none", "/leave_out/fog", false}};
    runs.plan.buffers = {{"tree", 1 << 20}, {"film", 3 << 20}};
    runs.plan.defines = {{"NEPHROID_SMOOTH", "0"}};
  }
  auto place_of(const std::string& pass) const { return workspace.panel<PlanPanel>().place_of(pass); }
  /// Clicks the box of a pass; the edit that this pushed.
  std::optional<command::Edit> click(const std::string& pass) {
    press_at(place_of(pass).value());
    let_go();
    const auto* edit = imgui.pushed<command::Edit>();
    return edit ? std::optional(*edit) : std::nullopt;
  }
};

TEST_F(PlanPanelTest, WhatAFieldDecidesHasABox) {
  frames(3);
  open();
  EXPECT_TRUE(place_of("direct"));
  EXPECT_TRUE(place_of("mirrors"));
  EXPECT_FALSE(place_of("indirect"));
  EXPECT_FALSE(place_of("fog")) << "the preset has no such field";
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(PlanPanelTest, ABoxEditsThePresetAndCanBeUndone) {
  open();
  const auto edit = click("mirrors");
  ASSERT_TRUE(edit);
  EXPECT_FALSE(edit->preset.leave_out);
  EXPECT_EQ(edit->label, "compute mirrors");
  preset::Preset back = edit->preset;
  back.leave_out = true;
  EXPECT_EQ(back, workbench.edits()->opened()) << "nothing else changed";
  EXPECT_FALSE(workbench.preset()->leave_out);
  const int made = runs.made;
  ASSERT_TRUE(until([&] { return runs.made > made || workbench.run().snapshot_is_current(); }));
  frames(2);
  const auto again = click("mirrors");
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->preset.leave_out);
  EXPECT_EQ(again->label, "leave out mirrors");
  const auto walls = click("walls");
  ASSERT_TRUE(walls);
  EXPECT_EQ(spectral::settings(walls->preset).indirect, true) << "the scene decided, and left it out";
  const auto direct = click("direct");
  ASSERT_TRUE(direct);
  EXPECT_FALSE(spectral::settings(direct->preset).direct) << "its box was checked: true is to run";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_TRUE(spectral::settings(*workbench.preset()).direct);
}

TEST_F(PlanPanelTest, AFieldThatThereIsNotIsRefused) {
  const preset::Preset preset = preset::parse_preset(test::preset_text, "test");
  EXPECT_FALSE(spectral::settings(with_field(preset, "/spectral/caustic", false)).caustic);
  EXPECT_THROW(with_field(preset, "/spectral/fog", false), Error);
}

TEST_F(PlanPanelTest, ThePlanIsCopiedAsJson) {
  EXPECT_FALSE(action("Copy plan as JSON").enabled(context()));
  open();
  action("Copy plan as JSON").run(context());
  EXPECT_EQ(std::string(ImGui::GetClipboardText()), plan::to_json(*workbench.run().plan()));
}

TEST_F(PlanPanelTest, AnotherPresetsPlanIsNotShownForThisOne) {
  open();
  EXPECT_NE(workbench.run().plan(), nullptr);
  runs.make_ms = 300;
  ASSERT_TRUE(workbench.open(folder.write("other.json", test::preset_text)));
  frame();
  EXPECT_EQ(workbench.run().plan(), nullptr);
  ASSERT_TRUE(until([&] { return workbench.run().plan() != nullptr; }));
  frames(2);
  EXPECT_TRUE(place_of("mirrors"));
}

} // namespace nephroid::ui::plan_panel_test
