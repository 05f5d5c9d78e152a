// SPDX-License-Identifier: Apache-2.0
// Opening files in the window: what it asks before unsaved changes go, and what it says about files that are no preset.
#include "headless.h"
#include "workbench_fixture.h"

namespace nephroid::ui::opening_test {

class OpeningTest : public test::WorkbenchFixture {
protected:
  const std::string first = folder.write("first.json", test::preset_text);
  const std::string second = folder.write("second.json", R"({"name": "Second", "parent": "first.json"})");

  void open_and_edit()
  {
    ASSERT_TRUE(workbench.open(first));
    edit([](preset::Preset& p) { p.scene.camera.position = {0, 0, 2}; });
    ASSERT_TRUE(workbench.edits()->modified());
  }
  std::string refusal(const std::string& file)
  {
    try {
      refuse_other_kinds(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      return error.line();
    }
    return {};
  }
};

TEST_F(OpeningTest, WithoutChangesNothingIsAsked)
{
  ASSERT_TRUE(workbench.open(first));
  workbench.apply({command::Open{second}});
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_EQ(workbench.preset()->name, "Second");
  workbench.apply({command::Quit{}});
  EXPECT_TRUE(workbench.quitting());
}

TEST_F(OpeningTest, QuittingAsksBeforeChangesGo)
{
  open_and_edit();
  workbench.apply({command::Quit{}});
  EXPECT_FALSE(workbench.quitting());
  EXPECT_EQ(workbench.question(), Question::unsaved);
  ASSERT_NE(workbench.waiting(), nullptr);
  workbench.apply({*workbench.waiting()});
  EXPECT_TRUE(workbench.quitting());
}

TEST_F(OpeningTest, AnotherPresetAsksBeforeChangesGo)
{
  open_and_edit();
  workbench.apply({command::Open{second}});
  EXPECT_EQ(workbench.question(), Question::unsaved);
  EXPECT_EQ(workbench.preset()->name, "Test") << "still there";
  workbench.apply({command::Ask{Question::none}});
  EXPECT_EQ(workbench.waiting(), nullptr);
  EXPECT_EQ(workbench.preset()->scene.camera.position[2], 2);
  workbench.apply({command::Open{second}});
  workbench.apply({*workbench.waiting()});
  EXPECT_EQ(workbench.preset()->name, "Second");
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_EQ(preset::read_preset(first).scene.camera.position[2], 4) << "not saved";
}

TEST_F(OpeningTest, OnceTheChangesAreSavedWhatWaitedGoesOn)
{
  open_and_edit();
  workbench.apply({command::Open{second}});
  workbench.apply({command::SavePreset{folder.path() / "missing" / "first.json"}});
  EXPECT_EQ(workbench.question(), Question::unsaved) << "saving failed: the question stays";
  EXPECT_EQ(workbench.preset()->name, "Test");
  workbench.apply({command::Ask{Question::save_preset}}); // "Save as..." in the dialog
  workbench.apply({command::SavePreset{folder.path() / "third.json"}});
  EXPECT_EQ(workbench.preset()->name, "Second");
  EXPECT_EQ(preset::read_preset((folder.path() / "third.json").string()).scene.camera.position[2], 2);
  EXPECT_EQ(workbench.question(), Question::none);
}

TEST_F(OpeningTest, WhatCannotBeOpenedAsksNothing)
{
  open_and_edit();
  workbench.apply({command::Open{folder.write("broken.json", "{")}, command::Open{folder.write("ball.obj", "v 0 0 0\n")}});
  EXPECT_TRUE(until([&] { return workbench.messages().size() == 2; })) << "a mesh is read in the background";
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_TRUE(workbench.edits()->modified());
}

TEST_F(OpeningTest, TheDialogSavesAndOpens)
{
  test::Headless imgui;
  Workspace workspace;
  open_and_edit();
  workbench.apply({command::Open{second}});
  const auto frame = [&] { imgui.frame(workspace, workbench); };
  for (int i = 0; i < 3; ++i) frame();
  const auto press = [&](ImGuiKey key) {
    imgui.key(key, true);
    frame();
    imgui.key(key, false);
    frame();
  };
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  press(ImGuiKey_Tab); // to the first button
  press(ImGuiKey_Space);
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_EQ(workbench.preset()->name, "Second");
  EXPECT_EQ(preset::read_preset(first).scene.camera.position[2], 2) << "saved";
  EXPECT_EQ(workbench.question(), Question::none);
}

TEST_F(OpeningTest, AMapBecomesTheEnvironment)
{
  const std::string map = folder.write("hall.hdr", "read by the run"), other = folder.write("sky.EXR", "");
  workbench.apply({command::Open{map}});
  ASSERT_EQ(workbench.messages().size(), 1u) << "no preset is open";
  EXPECT_THAT(workbench.messages()[0].line, ::testing::HasSubstr("once a preset is open"));
  open_and_edit();
  workbench.apply({command::Open{map}});
  ASSERT_TRUE(workbench.preset()->scene.environment);
  EXPECT_EQ(workbench.preset()->scene.environment->file, map);
  EXPECT_EQ(workbench.question(), Question::none);
  EXPECT_EQ(workbench.edits()->undo_label(), "surround with hall.hdr");
  edit([](preset::Preset& p) {
    p.scene.environment->radiance = 3;
    p.scene.environment->rotate_deg = 40;
    p.scene.environment->lights = true;
  });
  workbench.apply({command::Open{other}});
  preset::Environment expected;
  expected.file = other;
  expected.radiance = 3;
  expected.rotate_deg = 40;
  expected.lights = true;
  EXPECT_EQ(workbench.preset()->scene.environment, expected);
  for (int i = 0; i < 3; ++i) workbench.apply({command::Undo{}});
  EXPECT_FALSE(workbench.preset()->scene.environment);
}

// An engine that has no use for surroundings says so, and nothing changes.
TEST_F(OpeningTest, AMapThatThePresetCannotHaveIsRefused)
{
  ASSERT_TRUE(workbench.open(folder.write("inverse.json", R"({"engine": "inverse", "inverse": {"receivers": [
    {"distance_mm": 100, "picture": {"type": "disc", "radius": 0.3}}]}})")));
  workbench.apply({command::Open{folder.write("hall.hdr", "")}});
  ASSERT_EQ(workbench.messages().size(), 1u);
  EXPECT_THAT(workbench.messages()[0].line, ::testing::HasSubstr("environment"));
  EXPECT_TRUE(workbench.messages()[0].error);
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(OpeningTest, FilesDroppedTogetherKeepTheirMessages)
{
  workbench.apply({command::Open{folder.write("ball.obj", "v 0 0 0\n")}, command::Open{first}});
  EXPECT_EQ(workbench.preset()->name, "Test");
  ASSERT_EQ(workbench.messages().size(), 1u);
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("is a mesh"));
  workbench.apply({command::Open{first}});
  EXPECT_TRUE(workbench.messages().empty()) << "an earlier error is over";
}

TEST_F(OpeningTest, SaysWhatOtherFilesAreAndWhatCanBeDoneWithThem)
{
  const std::string glass = std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/N-BK7.yml";
  EXPECT_THAT(refusal(glass), StartsWith(glass + ": is dispersion data; the window opens presets; "));
  EXPECT_THAT(refusal(glass), HasSubstr("`nephroid dispersion " + glass + "`"));
  EXPECT_THAT(refusal(folder.write("BALL.OBJ", "v 0 0 0\n")), HasSubstr("is a mesh; the window opens presets; drop it on the window once"));
  EXPECT_THAT(refusal(folder.write("scene.gltf", "{\"asset\": {}}")),
              HasSubstr("is a scene; the window opens presets; drop it on the window"));
  EXPECT_THAT(refusal(folder.write("sky.exr", "v/1")), HasSubstr("is a picture"));
  EXPECT_THAT(refusal(folder.write("direct.cl", "__kernel")), HasSubstr("--kernels"));
  EXPECT_THAT(refusal(folder.write("notes.txt", "hello")), HasSubstr("is no preset"));
  EXPECT_THAT(refusal(folder.write("noise", std::string("\0\1\2", 3))), HasSubstr("is no preset"));
}

TEST_F(OpeningTest, LeavesPresetsToTheReader)
{
  EXPECT_EQ(refusal(first), "");
  EXPECT_EQ(refusal("first-light"), "");
  EXPECT_EQ(refusal(folder.path().string()), "");
  EXPECT_EQ(refusal((folder.path() / "missing.obj").string()), "");
  EXPECT_EQ(refusal(folder.write("broken.json", "]")), "") << "the reader names line and column";
  EXPECT_EQ(refusal(folder.write("preset.txt", " \n{}")), "");
  EXPECT_EQ(refusal(folder.write("empty", "")), "");
}

} // namespace nephroid::ui::opening_test
