// SPDX-License-Identifier: Apache-2.0
// The whole window without a display: the mouse and the keys are injected, the preset and the commands are looked at.
#include "ui/shell/status_line.h"
#include "window_fixture.h"

namespace nephroid::ui::panels_test {

class PanelsTest : public test::WindowFixture {};

TEST_F(PanelsTest, DrawsWithNothingOpen) {
  frames(3);
  EXPECT_TRUE(imgui.commands.empty());
  EXPECT_EQ(view().canvas().size[0], 0) << "the start page is there in its place";
  drag_between({300, 300}, {350, 300});
  EXPECT_EQ(workbench.preset(), nullptr);
}

TEST_F(PanelsTest, ShowsTheJobsPicture) {
  open();
  // The camera at (0, 0, 4): no red, no green, blue beyond white.
  const auto pixels = view().texture().pixels();
  ASSERT_EQ(pixels.size(), 4u * 64 * 48);
  EXPECT_EQ(int(pixels[0]), 0);
  EXPECT_EQ(int(pixels[2]), 255);
}

TEST_F(PanelsTest, LeftDragOrbitsAsOneEntry) {
  open();
  const double height = 48 * place(workbench.view_state().view_settings, view().canvas(), {64, 48}).scale;
  drag(0, height / 2, 0); // half the picture's height: a quarter round; the scene goes right, the camera left
  EXPECT_NEAR(camera().position[0], -4, 0.1);
  EXPECT_NEAR(camera().position[2], 0, 0.1);
  EXPECT_NEAR(distance(), 4, 1e-9);
  ASSERT_TRUE(until_current());
  EXPECT_NEAR(workbench.run().snapshot()->picture->rgb[0], -4, 0.1) << "the run was started again with that camera";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(camera().position, (preset::Vec3{0, 0, 4}));
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(PanelsTest, MiddleDragAndShiftDragPan) {
  open();
  drag(2, 40, 0);
  EXPECT_LT(camera().target[0], 0) << "the scene follows the mouse: the camera goes the other way";
  const preset::Camera by_middle = camera();
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  imgui.key(ImGuiMod_Shift, true);
  drag(0, 40, 0);
  imgui.key(ImGuiMod_Shift, false);
  EXPECT_EQ(camera().target, by_middle.target);
  EXPECT_EQ(camera().position, by_middle.position);
}

TEST_F(PanelsTest, TheWheelMovesTheCameraAndIsOneEntry) {
  open();
  imgui.move(middle()[0], middle()[1]);
  frame();
  for (int i = 0; i < 3; ++i) {
    imgui.wheel(1);
    frame();
  }
  EXPECT_NEAR(distance(), 4 / (1.1 * 1.1 * 1.1), 1e-9);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_NEAR(distance(), 4, 1e-12);
}

TEST_F(PanelsTest, RightDragMovesTheCamera) {
  open();
  drag(1, 0, -60);
  EXPECT_LT(distance(), 4);
  EXPECT_EQ(camera().target, (preset::Vec3{0, 0, 0}));
}

TEST_F(PanelsTest, WithCtrlThePictureMovesAndNotTheCamera) {
  open();
  const int made = runs.made;
  imgui.key(ImGuiMod_Ctrl, true);
  imgui.move(middle()[0], middle()[1]);
  frame();
  imgui.wheel(2);
  frame();
  const double zoom = workbench.view_state().view_settings.zoom;
  EXPECT_FALSE(workbench.view_state().view_settings.fit);
  drag(0, 30, 0);
  imgui.key(ImGuiMod_Ctrl, false);
  frame();
  EXPECT_NEAR(workbench.view_state().view_settings.centre[0], 32 - 30 / zoom, 0.1);
  EXPECT_EQ(camera().position, (preset::Vec3{0, 0, 4}));
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(runs.made, made) << "how a picture is shown needs no new run";
  press(ImGuiKey_F);
  EXPECT_TRUE(workbench.view_state().view_settings.fit);
}

TEST_F(PanelsTest, ExposureKeysChangeTheTextureOnly) {
  runs.steps = 1;
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"scene.camera.position=[0.1, 0.2, 0.4]"}));
  ASSERT_TRUE(until(job::State::finished));
  frame();
  const unsigned char before = view().texture().pixels()[1];
  press(ImGuiKey_E, ImGuiMod_Shift);
  press(ImGuiKey_E, ImGuiMod_Shift);
  EXPECT_EQ(workbench.view_state().view_settings.exposure_stops, -1);
  EXPECT_LT(view().texture().pixels()[1], before);
  press(ImGuiKey_0);
  EXPECT_EQ(view().texture().pixels()[1], before);
  EXPECT_EQ(runs.made, 1);
}

TEST_F(PanelsTest, TheStatusLineSaysWhatTheRunDoes) {
  runs.steps = 100000;
  EXPECT_EQ(workbench.run().preparation(), "");
  open();
  EXPECT_EQ(workbench.run().preparation(), "") << "it runs";
  runs.reads_on = true;
  press(ImGuiKey_F5);
  ASSERT_TRUE(until([&] { return workbench.run().preparation() == "reading bunny.obj"; }));
}

TEST_F(PanelsTest, WhatIsReadForLongIsNotWaitedFor) {
  runs.steps = 100000;
  runs.make_ms = 1;
  runs.reads_on = true;
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
  ASSERT_TRUE(until([&] { return workbench.run().preparation() == "reading bunny.obj"; }));
  edit([](preset::Preset& p) { p.scene.camera.position[2] = 2; });
  frames(10);
  EXPECT_EQ(workbench.run().preparation(), "reading bunny.obj") << "another camera waits for the same files";
  press(ImGuiKey_F5, ImGuiMod_Shift);
  ASSERT_TRUE(until(job::State::cancelled));
  press(ImGuiKey_F5);
  ASSERT_TRUE(until([&] { return workbench.run().preparation() == "reading bunny.obj"; }));
  runs.reads_on = false;
  ASSERT_TRUE(until(job::State::running));
  EXPECT_EQ(runs.made, 1) << "neither the first nor the second";
  runs.reads_on = true;
  press(ImGuiKey_F5);
  ASSERT_TRUE(until([&] { return workbench.run().preparation() == "reading bunny.obj"; }));
  ASSERT_TRUE(workbench.open(folder.write("other.json", test::preset_text)));
  ASSERT_TRUE(until([&] { return workbench.run().preparation() == "reading bunny.obj"; }))
      << "the first is read no more";
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(PanelsTest, EscapeClosesTheHelpFirst) {
  runs.steps = 100000;
  open();
  press(ImGuiKey_F1);
  EXPECT_TRUE(workbench.setup().help_shown());
  press(ImGuiKey_Escape);
  EXPECT_FALSE(workbench.setup().help_shown());
  for (int i = 0; i < 20; ++i) { // the worker would take a while to be cancelled
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(workbench.run().status().state, job::State::running);
}

TEST_F(PanelsTest, ANoteMovesNothing) {
  open();
  frames(2);
  const double height = view().canvas().size[1];
  apply({command::Report{"something is saved", false}});
  ASSERT_EQ(workbench.messages().size(), 1u);
  EXPECT_EQ(view().canvas().size[1], height);
}

TEST_F(PanelsTest, AnErrorTakesAStripThatGoesWhenItIsDismissed) {
  open();
  frames(2);
  const double height = view().canvas().size[1];
  apply({command::Open{(folder.path() / "missing.json").string()}});
  ASSERT_EQ(workbench.messages().size(), 1u);
  EXPECT_LT(view().canvas().size[1], height - 20);
  EXPECT_NE(workbench.preset(), nullptr);
  apply({command::Dismiss{workbench.messages()[0].id}});
  EXPECT_EQ(view().canvas().size[1], height);
}

/// A panel that fails with windows, groups and identifiers open.
class FailingPanel : public Panel {
public:
  void draw(const Context&) override {
    ImGui::PushID("deep");
    ImGui::BeginGroup();
    ImGui::BeginChild("inside");
    throw std::runtime_error("index out of range");
  }
};

TEST_F(PanelsTest, APanelThatThrowsBecomesOneMessage) {
  open();
  workspace.add({"failing", "Failing", "", nullptr}, std::make_unique<FailingPanel>());
  frames(5);
  EXPECT_EQ(only_message(workbench), "Failing: index out of range");
  drag(0, 100, 0); // the others go on
  EXPECT_TRUE(workbench.edits()->modified());
}

class CountingPanel : public Panel {
public:
  explicit CountingPanel(int& drawn) : drawn_(drawn) {}
  void draw(const Context&) override { ++drawn_; }

private:
  int& drawn_;
};

TEST_F(PanelsTest, APanelIsThereForThePresetsOfItsEngineOnly) {
  int of_this = 0, of_another = 0, of_all = 0;
  workspace.add({"this", "This", "spectral", nullptr}, std::make_unique<CountingPanel>(of_this));
  workspace.add({"another", "Another", "anagram", nullptr}, std::make_unique<CountingPanel>(of_another));
  workspace.add({"all", "All", "", nullptr}, std::make_unique<CountingPanel>(of_all));
  frames(3);
  EXPECT_EQ(of_this + of_another + of_all, 0) << "nothing is open";
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text)));
  frames(4);
  EXPECT_EQ(of_this, 4);
  EXPECT_EQ(of_another, 0);
  EXPECT_EQ(of_all, 4);
}

TEST(Layouts, AreNamedAfterThePanelInFront) {
  for (const char* name : {"", "error", "dispersion", "spectra", "plan", "parameters"})
    EXPECT_NO_THROW(check_layout(name)) << name;
  EXPECT_THROW(check_layout("view"), Error) << "it has a side of its own";
  for (const PanelEntry& entry : panel_table().subspan(1)) EXPECT_NO_THROW(check_layout(std::string(entry.name)));
}

TEST_F(PanelsTest, KeysBelongToADialogWhileItIsOpen) {
  runs.steps = 100000;
  open();
  press(ImGuiKey_S, ImGuiMod_Ctrl);
  EXPECT_EQ(workbench.questions().question(), Question::none) << "the preset has a file of its own";
  EXPECT_THAT(only_message(workbench), StartsWith("saved "));
  apply({command::Ask{Question::save_picture}});
  press(ImGuiKey_E);
  EXPECT_EQ(workbench.view_state().view_settings.exposure_stops, 0);
  press(ImGuiKey_Escape);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_NE(workbench.run().status().state, job::State::cancelled);
}

TEST_F(PanelsTest, AnotherResolutionGetsAnotherTexture) {
  open();
  for (int size : {32, 80, 16}) {
    edit([&](preset::Preset& p) { p.scene.camera.resolution = {size, size}; });
    ASSERT_TRUE(until_current());
    frames(3);
    EXPECT_EQ(view().texture().pixels().size(), 4u * static_cast<unsigned>(size * size));
  }
}

TEST_F(PanelsTest, APictureBeyondTheRenderersTexturesIsSaidNotDrawn) {
  runs.steps = 100000;
  open();
  const PictureTexture& texture = view().texture();
  const std::vector<unsigned char> before(texture.pixels().begin(), texture.pixels().end());
  const auto drawn_pictures = [&] { // commands of the frame that use the picture's texture
    int count = 0;
    for (const ImDrawList* list : ImGui::GetDrawData()->CmdLists)
      for (const ImDrawCmd& c : list->CmdBuffer) count += c.TexRef._TexData == texture.ref()._TexData;
    return count;
  };
  EXPECT_EQ(drawn_pictures(), 1);
  ImGui::GetPlatformIO().Renderer_TextureMaxWidth = ImGui::GetPlatformIO().Renderer_TextureMaxHeight = 50;
  apply({command::SetViewSettings{{.exposure_stops = -3}}});
  EXPECT_EQ(drawn_pictures(), 0);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), texture.pixels().begin())) << "64 x 48 is not uploaded";
  EXPECT_TRUE(workbench.messages().empty());
  ImGui::GetPlatformIO().Renderer_TextureMaxWidth = ImGui::GetPlatformIO().Renderer_TextureMaxHeight = 64;
  frames(2);
  EXPECT_EQ(drawn_pictures(), 1);
}

TEST(StatusLine, SaysRatesAndTimesAsAPersonWould) {
  EXPECT_EQ(duration_text(9.6), "10 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
}

} // namespace nephroid::ui::panels_test
