// SPDX-License-Identifier: Apache-2.0
// What leaves the window and what comes in from nothing: the command line on the clipboard, saving with the parent
// kept, new scenes, a glTF file that is dropped.
#include "preset/differences.h"
#include "window_fixture.h"

namespace nephroid::ui::saving_test {

using Json = nlohmann::json;

class SavingTest : public test::WindowFixture {
protected:
  const std::string parent = folder.write("parent.json", test::preset_text);
  const std::string child = folder.write("child.json", R"({"parent": "parent.json", "seed": 5})");

  void set_white(double white) {
    edit([&](preset::Preset& p) { p.white = white; });
  }
  static Json read(const fs::path& file) { return Json::parse(read_file(file)); }
  void press_with_shift(ImGuiKey key) {
    imgui.key(ImGuiMod_Shift, true);
    press(key, ImGuiMod_Ctrl);
    imgui.key(ImGuiMod_Shift, false);
    frame();
  }
};

TEST_F(SavingTest, TheCommandLineIsOnTheClipboard) {
  open_file(child);
  set_white(2.5);
  press_with_shift(ImGuiKey_C);
  EXPECT_EQ(std::string(ImGui::GetClipboardText()), "nephroid run " + preset::shell_word(child) + " --set white=2.5");
  EXPECT_EQ(last_message(workbench), "copied the command line");
}

TEST_F(SavingTest, WithoutAFileTheCommandLineSaysToSaveFirst) {
  apply({command::New{engine::engines().front()->introduction.new_scene.preset}});
  ImGui::SetClipboardText("before");
  press_with_shift(ImGuiKey_C);
  EXPECT_EQ(std::string(ImGui::GetClipboardText()), "before");
  EXPECT_THAT(last_message(workbench), HasSubstr("save the preset first"));
}

TEST_F(SavingTest, SaveKeepsTheParent) {
  open_file(child);
  set_white(2.5);
  press(ImGuiKey_S, ImGuiMod_Ctrl);
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(read(child), Json::parse(R"({"parent":"parent.json","seed":5,"white":2.5})"));
  EXPECT_TRUE(preset::read_preset(child) == *workbench.preset());
}

TEST_F(SavingTest, SaveAsOffersTheParentAndNamesItFromTheNewFolder) {
  fs::create_directories(folder.path() / "deep");
  open_file(child);
  press_with_shift(ImGuiKey_S);
  frames(3);
  ASSERT_TRUE(workspace.dialogs().place_of("keep the parent"));
  retype(folder.path() / "deep/saved.json");
  press(ImGuiKey_Enter);
  EXPECT_EQ(read(folder.path() / "deep/saved.json"),
            Json::parse(R"({"parent":"../parent.json","name":"child","seed":5})"));
  EXPECT_EQ(workbench.preset()->source, folder.path() / "deep/saved.json");
}

TEST_F(SavingTest, WithoutTheCheckTheParentIsNotKept) {
  open_file(child);
  press_with_shift(ImGuiKey_S);
  frames(3);
  retype(folder.path() / "saved.json");
  click(*workspace.dialogs().place_of("keep the parent"));
  click(*workspace.dialogs().place_of("save"));
  frames(2);
  const Json saved = read(folder.path() / "saved.json");
  EXPECT_FALSE(saved.contains("parent"));
  EXPECT_EQ(saved["seed"], 5);
}

TEST_F(SavingTest, AShippedPresetIsSavedWholeUnlessItsParentIsKept) {
  open_file("spectral/prism");
  workbench.apply({command::SavePreset{folder.path() / "whole.json", false}});
  EXPECT_FALSE(read(folder.path() / "whole.json").contains("parent"));
  open_file("spectral/prism");
  set_white(7);
  workbench.apply({command::SavePreset{folder.path() / "over.json", true}});
  const Json over = read(folder.path() / "over.json");
  EXPECT_EQ(over["parent"], "spectral/prism");
  EXPECT_EQ(over["white"], 7);
  EXPECT_FALSE(over.contains("scene"));
  EXPECT_TRUE(preset::read_preset((folder.path() / "over.json").string()) == *workbench.preset());
}

TEST_F(SavingTest, WhereTheParentCannotBeKeptTheFileIsWholeAndANoteSaysWhy) {
  open_file(child);
  fs::remove(parent);
  set_white(3);
  press(ImGuiKey_S, ImGuiMod_Ctrl);
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_FALSE(read(child).contains("parent"));
  EXPECT_EQ(preset::read_preset(child).white, 3);
  EXPECT_THAT(last_message(workbench), HasSubstr("is saved whole, without its parent 'parent.json'"));
  EXPECT_FALSE(workbench.messages().back().error);
}

TEST_F(SavingTest, AfterSavingElsewhereFilesAreFoundAsBefore) {
  fs::create_directories(folder.path() / "other");
  folder.write("own.yml", "");
  open_file(folder.write(
      "glass.json",
      R"({"engine":"spectral","scene":{"materials":{"g":{"type":"dielectric","dispersion":"own.yml"}}}})"));
  workbench.apply({command::SavePreset{folder.path() / "other/glass.json"}});
  EXPECT_EQ(workbench.preset()->scene.materials.at("g").dispersion.file,
            fs::canonical(folder.path() / "own.yml").string());
  EXPECT_TRUE(preset::read_preset((folder.path() / "other/glass.json").string()) == *workbench.preset());
}

TEST_F(SavingTest, NewScenesAreInNoFileAndAskBeforeChangesGo) {
  open_file(child);
  press(ImGuiKey_N, ImGuiMod_Ctrl);
  EXPECT_EQ(workbench.preset()->name, "untitled");
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_TRUE(save_target(workbench.preset()).empty());
  set_white(2);
  press(ImGuiKey_N, ImGuiMod_Ctrl);
  EXPECT_EQ(workbench.questions().question(), Question::unsaved);
  EXPECT_EQ(workbench.preset()->white, 2);
  frames(2);
  workbench.apply({*workbench.questions().waiting()});
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_NE(workbench.preset()->white, 2);
  for (const engine::Engine* engine : engine::engines()) {
    workbench.apply({command::New{engine->introduction.new_scene.preset, true}});
    EXPECT_EQ(workbench.preset()->settings.engine(), name_of(*engine));
    workbench.apply({command::SavePreset{folder.path() / "new.json"}});
    EXPECT_TRUE(preset::read_preset((folder.path() / "new.json").string()) == *workbench.preset());
  }
}

TEST_F(SavingTest, ADroppedSceneBecomesAPresetInAFolderOfItsOwn) {
  // A triangle with corners (0, 0, 0), (1, 0, 0), (0, 1, 0), without indices.
  const std::string text = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const std::string file = folder.write("tri.gltf", text);
  workbench.apply({command::Open{file}});
  ASSERT_TRUE(until_files_are_done());
  ASSERT_TRUE(workbench.preset()) << last_message(workbench);
  EXPECT_EQ(workbench.preset()->source, folder.path() / "tri-scene/tri.json");
  EXPECT_EQ(workbench.preset()->scene.objects.size(), 1u);
  workbench.apply({command::Open{file}});
  ASSERT_TRUE(until_files_are_done());
  EXPECT_EQ(workbench.preset()->source, folder.path() / "tri-scene-2/tri.json")
      << "the first may have been edited since";
  workbench.apply({command::Open{folder.write("cut.glb", "glTF")}});
  ASSERT_TRUE(until_files_are_done());
  EXPECT_THAT(last_message(workbench), HasSubstr("cut.glb: is cut"));
  EXPECT_EQ(workbench.preset()->source, folder.path() / "tri-scene-2/tri.json");
}

} // namespace nephroid::ui::saving_test
