// SPDX-License-Identifier: Apache-2.0
// The list of files in the dialogs, under an injected mouse and keys: folders and files are gone through, picked and
// opened; folders that vanish, names of no file, files that are there already.
#include "tests/support/process_state.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::file_list_test {

class FileListTest : public test::WindowFixture {
protected:
  FileListTest() {
    ImGui::GetIO().DisplaySize = {1300, 900};
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    runs.steps = 1000000;
  }
  /// The dialog, on the folder of the open preset.
  void ask(Question question) {
    open();
    workbench.apply({command::Ask{question}});
    frames(4);
    if (question != Question::open) read(); // else the files are behind a tab
  }
  /// In a folder with others.
  void ask_for_history() {
    for (const char* file : {"runs/history.csv", "runs/notes.txt", "runs/.hidden.csv", "B.csv", "a.CSV"})
      folder.write(file, "");
    fs::create_directories(folder.path() / "runs" / "deep");
    ask(Question::open_history);
  }
  const FileList& files() const { return workspace.dialogs().files(); }
  void read() {
    ASSERT_TRUE(until([&] { return files().note() != "Reading the folder"; }));
    frames(2);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const FileList::Entry& entry : files().entries()) all.push_back(entry.path.filename().string());
    return all;
  }
  void click_on(const std::string& widget) {
    click_in(files(), widget, 2);
    read();
  }
};

// A preset that is named without a folder lies in the present one.
TEST_F(FileListTest, BeginsInThePresentFolderWhereThePresetHasNone) {
  const test::CurrentFolder here(folder.path());
  folder.write("near.json", test::preset_text);
  ASSERT_TRUE(workbench.open("near.json"));
  workbench.apply({command::Ask{Question::save_preset}});
  frames(4);
  read();
  EXPECT_THAT(names(), ElementsAre("near.json"));
  EXPECT_TRUE(fs::equivalent(files().folder(), folder.path()));
  EXPECT_TRUE(files().folder().has_filename()) << "Up goes to its parent at once";
}

TEST_F(FileListTest, FoldersComeFirstAndOnlyWantedKindsAreThere) {
  ask_for_history();
  EXPECT_EQ(files().folder(), folder.path());
  EXPECT_THAT(names(), ElementsAre("runs", "a.CSV", "B.csv"));
}

TEST_F(FileListTest, AClickGoesIntoAFolderAndUpComesBack) {
  ask_for_history();
  click_on("runs");
  EXPECT_EQ(files().folder(), folder.path() / "runs");
  EXPECT_THAT(names(), ElementsAre("deep", "history.csv"));
  click_on("deep");
  EXPECT_TRUE(names().empty());
  EXPECT_THAT(files().note(), HasSubstr("Nothing of the kind"));
  click_on("up");
  click_on("up");
  EXPECT_EQ(files().folder(), folder.path());
}

TEST_F(FileListTest, AClickPicksAndADoubleClickOpens) {
  ask_for_history();
  click_on("B.csv");
  EXPECT_EQ(files().picked(), folder.path() / "B.csv");
  EXPECT_EQ(workbench.questions().question(), Question::open_history) << "one click only names it";
  click_on("B.csv");
  ASSERT_TRUE(until([&] { return !workbench.messages().empty(); })) << "it is read, and is no history";
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("B.csv"));
}

TEST_F(FileListTest, TheKeyboardAloneGoesThroughTheList) {
  ask_for_history();
  // From the text field to the list; down to the last file.
  for (int i = 0; i < 20 && files().picked().empty(); ++i) {
    press(ImGuiKey_Tab);
    const auto place = files().place_of("a.CSV");
    const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow;
    if (!place || !window) continue;
    const ImRect marked =
        ImGui::WindowRectRelToAbs(const_cast<ImGuiWindow*>(window), window->NavRectRel[ImGuiNavLayer_Main]);
    if (marked.Contains(ImVec2(static_cast<float>((*place)[0]), static_cast<float>((*place)[1]))))
      press(ImGuiKey_Enter);
    frames(2);
  }
  EXPECT_EQ(files().picked(), folder.path() / "a.CSV");
  ASSERT_TRUE(until([&] { return !workbench.messages().empty(); })) << "Enter opens it";
}

TEST_F(FileListTest, AFolderThatVanishesSaysSo) {
  ask_for_history();
  fs::remove_all(folder.path() / "runs");
  click_on("runs");
  EXPECT_TRUE(names().empty());
  EXPECT_THAT(files().note(), HasSubstr("cannot be read"));
  click_on("up");
  EXPECT_THAT(names(), ElementsAre("a.CSV", "B.csv")) << "the way out of it";
}

TEST_F(FileListTest, AFileThatVanishesIsSaid) {
  ask_for_history();
  fs::remove(folder.path() / "B.csv");
  click_on("B.csv");
  click_on("B.csv");
  ASSERT_TRUE(until([&] { return !workbench.messages().empty(); }));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("B.csv"));
  EXPECT_EQ(workbench.preset()->name, "Test") << "nothing else changed";
}

TEST_F(FileListTest, ATypedNameOfNoFileIsSaidAndNothingIsLost) {
  ask(Question::open);
  type((folder.path() / "missing.json").string());
  press(ImGuiKey_Enter);
  EXPECT_THAT(last_message(workbench), HasSubstr("missing.json"));
  EXPECT_EQ(workbench.preset()->name, "Test");
}

TEST_F(FileListTest, ATypedNameIsOpened) {
  folder.write("other.json", R"({"parent": "test.json", "name": "Other"})");
  ask(Question::open);
  type((folder.path() / "other.json").string());
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.preset()->name, "Other");
  EXPECT_EQ(workbench.questions().question(), Question::none);
}

// A click on a file that is there only names it. The button then says "Replace", and the file is as it was until that
// is pressed.
TEST_F(FileListTest, AFileIsReplacedByTheButtonOnly) {
  folder.write("kept.json", R"({"name": "Kept"})");
  ask(Question::save_preset);
  click_on("kept.json");
  EXPECT_EQ(files().picked(), folder.path() / "kept.json");
  click_on("kept.json");
  frames(3);
  EXPECT_EQ(workbench.questions().question(), Question::save_preset) << "nor does a double click replace it";
  EXPECT_EQ(read_file(folder.path() / "kept.json"), R"({"name": "Kept"})");
  click(workspace.dialogs().place_of("save").value());
  frames(3);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(preset::read_preset((folder.path() / "kept.json").string()).name, "Test");
}

TEST_F(FileListTest, EnterReplacesAFileTheSecondTimeOnly) {
  const fs::path kept = folder.write("kept.json", R"({"name": "Kept"})");
  ask(Question::save_preset);
  type(kept.string());
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.questions().question(), Question::save_preset) << "it asks once more";
  EXPECT_EQ(read_file(kept), R"({"name": "Kept"})");
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(preset::read_preset(kept.string()).name, "Test");
}

TEST_F(FileListTest, APresetThatIsSavedGetsItsEnding) {
  ask(Question::save_preset);
  press(ImGuiKey_A, ImGuiMod_Ctrl);
  type((folder.path() / "mine").string());
  press(ImGuiKey_Enter);
  EXPECT_EQ(preset::read_preset((folder.path() / "mine.json").string()).name, "Test");
}

TEST_F(FileListTest, AMapIsChosenAmongMapsAndBecomesTheEnvironment) {
  for (const char* file : {"hall.hdr", "sky.EXR", "face.png", "notes.txt"}) folder.write(file, "");
  ask(Question::open_map);
  EXPECT_THAT(names(), ElementsAre("hall.hdr", "sky.EXR"));
  click_on("hall.hdr");
  EXPECT_EQ(workbench.questions().question(), Question::open_map) << "one click only names it";
  click_on("hall.hdr");
  EXPECT_EQ(workbench.questions().question(), Question::none);
  ASSERT_TRUE(workbench.preset()->scene.environment);
  EXPECT_EQ(fs::path(workbench.preset()->scene.environment->file).filename(), "hall.hdr");
}

TEST_F(FileListTest, WhatIsTypedAndIsNoMapLeavesTheDialogOpen) {
  for (const std::string& name : {(folder.path() / "nowhere.hdr").string(), folder.write("face.png", "")}) {
    ask(Question::open_map);
    retype(name);
    press(ImGuiKey_Enter);
    EXPECT_THAT(last_message(workbench), HasSubstr(name));
    EXPECT_EQ(workbench.questions().question(), Question::open_map);
    press(ImGuiKey_Escape);
  }
  EXPECT_FALSE(workbench.preset()->scene.environment);
}

class QuestionOfQuitting : public FileListTest {
protected:
  /// With an edit that is not saved.
  void quit() {
    open();
    edit([](preset::Preset& p) { p.scene.camera.position[2] = 2; });
    workbench.apply({command::Quit{}});
    frames(4);
    ASSERT_EQ(workbench.questions().question(), Question::unsaved);
  }
  /// The window is as it was.
  void expect_nothing_happened() {
    EXPECT_EQ(workbench.questions().question(), Question::none);
    EXPECT_EQ(workbench.questions().waiting(), nullptr);
    EXPECT_FALSE(workbench.questions().quitting());
    EXPECT_TRUE(workbench.edits()->modified());
    EXPECT_NE(workbench.run().status().state, job::State::cancelled) << "Escape is the dialog's, not the run's";
  }
};

TEST_F(QuestionOfQuitting, IsCancelledByItsButton) {
  quit();
  click_in(workspace.dialogs(), "cancel");
  expect_nothing_happened();
}

TEST_F(QuestionOfQuitting, IsCancelledByEscape) {
  quit();
  press(ImGuiKey_Escape);
  expect_nothing_happened();
}

} // namespace nephroid::ui::file_list_test
