// SPDX-License-Identifier: Apache-2.0
// The panel "Presets" and the start page under an injected mouse and keys: search, filters, what a click says, opening
// by double click and by Enter, each card and button; the list of recent files, also when its file is damaged; small
// pictures, also broken ones.
#include "image/image.h"
#include "preset/differences.h"
#include "ui/presets/panel.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::ui::presets_panel_test {

class PresetsPanelTest : public test::WindowFixture {
protected:
  PresetsPanelTest() : test::WindowFixture("presets") {
    ImGui::GetIO().DisplaySize = {1300, 950};
    runs.steps = 1000000;
    workbench.remember({list_file, folder.path() / "thumbnails"});
  }
  const PresetsPanel& panel() const { return workspace.panel<PresetsPanel>(); }
  /// Until everything is read.
  void rest() {
    ASSERT_TRUE(until([&] {
      return panel().catalogue().readings() > 0 && workbench.tasks().empty() &&
             !panel().thumbnails().busy(workbench.tasks());
    }));
    frames(2);
  }
  using test::WindowFixture::click;
  void click(const std::string& widget) { click_in(panel(), widget); }
  const CatalogueEntry& entry(const std::string& name) const {
    for (const CatalogueEntry& e : panel().catalogue().entries())
      if (e.name == name) return e;
    throw std::runtime_error("no entry " + name);
  }

  const fs::path list_file = folder.path() / "state" / "recent.json";
};

TEST_F(PresetsPanelTest, ListsEveryShippedPresetByName) {
  rest();
  std::vector<std::string> names;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets()) names.push_back(shipped.name);
  EXPECT_EQ(panel().listed(), names);
  for (const CatalogueEntry& e : panel().catalogue().entries()) {
    EXPECT_TRUE(e.problem.empty()) << e.problem;
    EXPECT_FALSE(e.description.empty()) << e.name;
    EXPECT_FALSE(e.engine.empty()) << e.name;
  }
  EXPECT_THAT(entry("first-light").resolution, ElementsAre(512, 512));
  EXPECT_EQ(entry("first-light").stop, "20 passes");
  std::vector<std::string> needs;
  for (const RequiredFile& need : entry("first-light").needs) needs.push_back(need.name);
  EXPECT_THAT(needs, UnorderedElementsAre("materials/N-SF66.yml", "bunny.obj"));
}

TEST_F(PresetsPanelTest, WordsAndTheEngineNarrowTheList) {
  rest();
  click("search");
  type("BUNNY glass");
  ASSERT_FALSE(panel().listed().empty());
  EXPECT_THAT(panel().listed(), Contains("first-light"));
  EXPECT_THAT(panel().listed(), Not(Contains("environment/ball")));
  type(" nothingcalledso");
  EXPECT_TRUE(panel().listed().empty());
  press(ImGuiKey_Escape);
  EXPECT_GT(panel().listed().size(), 20u);
  click("engine");
  click("engine:inverse");
  rest();
  EXPECT_THAT(panel().listed(), Contains("inverse/shapes"));
  for (const std::string& name : panel().listed()) EXPECT_EQ(entry(name).engine, "inverse");
}

TEST_F(PresetsPanelTest, AClickTellsAndADoubleClickOpens) {
  rest();
  click("environment/ball");
  EXPECT_EQ(panel().chosen(), entry("environment/ball").file);
  EXPECT_EQ(workbench.preset(), nullptr) << "one click looks only";
  click("environment/ball");
  const auto* opened = imgui.pushed<command::Open>();
  EXPECT_TRUE(opened || workbench.preset()) << "the second click within the time of a double click";
  frames(2);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, "ball");
  click("environment/beam");
  click("open");
  frames(2);
  EXPECT_EQ(workbench.preset()->name, "beam");
}

TEST_F(PresetsPanelTest, TheKeyboardAloneFindsAndOpens) {
  open();
  rest();
  press(ImGuiKey_P, ImGuiMod_Ctrl);
  type("inverse/s");
  const std::vector<std::string> listed = panel().listed();
  ASSERT_GE(listed.size(), 2u);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow);
  EXPECT_EQ(panel().chosen(), entry(listed[1]).file);
  press(ImGuiKey_UpArrow);
  EXPECT_EQ(panel().chosen(), entry(listed[0]).file);
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.preset()->source, entry(listed[0]).file);
}

TEST_F(PresetsPanelTest, UnsavedChangesAreAskedAbout) {
  open();
  rest();
  edit([&](preset::Preset& p) { p.white = 3; });
  click("environment/ball");
  click("open");
  EXPECT_EQ(workbench.questions().question(), Question::unsaved);
  EXPECT_EQ(workbench.preset()->name, "Test");
}

TEST_F(PresetsPanelTest, WhatWasOpenedIsListedInTheNextSessionTheNewestFirst) {
  open();
  workbench.open(folder.write("other.json", test::preset_text));
  ASSERT_TRUE(until([&] { return fs::exists(list_file); }));
  rest();
  EXPECT_THAT(panel().listed(), Contains("other.json"));
  click("newest");
  EXPECT_THAT(panel().listed().at(0), AnyOf("other.json", "test.json"));
  workbench.finish_files();
  const RecentFiles next(list_file, {});
  ASSERT_THAT(next.all(), SizeIs(2));
  EXPECT_EQ(next.all()[0].file, folder.path() / "other.json");
  EXPECT_EQ(next.all()[1].file, folder.path() / "test.json");
}

TEST_F(PresetsPanelTest, AFileThatIsGoneOrBrokenIsListedAsSuch) {
  open();
  folder.write("broken.json", "{");
  folder.write("recent.json", R"({"recent":[{"file":")" + (folder.path() / "gone.json").string() +
                                  R"(","opened":5},{"file":")" + (folder.path() / "broken.json").string() + R"("}]})");
  workbench.remember({folder.path() / "recent.json", {}});
  frames(2);
  rest();
  EXPECT_THAT(entry("gone.json").problem, HasSubstr("gone.json"));
  EXPECT_FALSE(entry("broken.json").problem.empty());
  EXPECT_THAT(panel().listed(), Contains("first-light"));
}

TEST_F(PresetsPanelTest, ASavedPresetGetsASmallPicture) {
  open();
  const fs::path file = folder.path() / "saved.json";
  workbench.apply({command::SavePreset{file}});
  const fs::path picture = thumbnail_of(file, folder.path() / "thumbnails");
  ASSERT_TRUE(until([&] { return fs::exists(picture) && !workbench.works_on_files(); }));
  const image::Image small = image::read_image(picture);
  EXPECT_EQ(small.width, 64); // the run's own size, which is smaller than a thumbnail may be
  EXPECT_EQ(small.height, 48);
  EXPECT_TRUE(fs::exists(file));
}

TEST(RecentFilesTest, ADamagedListIsEmptyWithOneNote) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "{", "[]", "{\"recent\":5}", "\xff\xfe", "{\"recent\":[{\"file\":"}) {
    RecentFiles files(folder.write("recent.json", text), {});
    EXPECT_TRUE(files.all().empty()) << text;
    EXPECT_THAT(files.take_note(), HasSubstr("begins anew")) << text;
    EXPECT_EQ(files.take_note(), "");
  }
  EXPECT_EQ(RecentFiles(folder.path() / "missing.json", {}).take_note(), "");
  const RecentFiles odd(
      folder.write(
          "recent.json",
          R"({"recent":[5,{"file":7},{"file":"relative.json"},{"file":"/a\nb"},{"file":"/a.json"},{"file":"/a.json"},
    {"file":"/b.json","opened":"late"},{"file":"/c.json","opened":-3}]})"),
      {});
  EXPECT_THAT(odd.all(), ElementsAre(RecentFile{"/a.json", 0}, RecentFile{"/b.json", 0}, RecentFile{"/c.json", 0}));
  write_file_whole(folder.path() / "recent.json", std::string(2 << 20, ' '));
  EXPECT_THAT(RecentFiles(folder.path() / "recent.json", {}).take_note(), HasSubstr("bytes long"));
}

TEST(RecentFilesTest, KeepsThirtyTheNewestFirstAndEachOnce) {
  const test::TemporaryFolder folder;
  const fs::path list = folder.path() / "deep" / "recent.json";
  RecentFiles files(list, {});
  for (int i = 0; i < 40; ++i) files.add("/recent/" + std::to_string(i % 35) + ".json", i);
  EXPECT_THAT(files.all(), SizeIs(30));
  EXPECT_EQ(files.all()[0], (RecentFile{"/recent/4.json", 39}));
  files.writer()();
  const RecentFiles again(list, {});
  EXPECT_EQ(again.all(), files.all());
  RecentFiles nowhere("/proc/nephroid/recent.json", {});
  nowhere.add("/a.json", 1);
  EXPECT_THAT(error_of([&] { nowhere.writer()(); }).line(), HasSubstr("recent files are not remembered"));
}

TEST(ThumbnailsTest, AreReadInTheBackgroundAndBrokenOnesAreNone) {
  const test::TemporaryFolder folder;
  test::Headless imgui;
  job::Picture picture{.width = 400, .height = 200};
  picture.rgb.assign(3 * 400 * 200, 1.0f);
  for (std::size_t i = 0; i < 3 * 400 * 100; ++i) picture.rgb[i] = 0; // the upper half is black
  write_thumbnail(folder.path() / "new" / "good.png", picture, {}, 0);
  folder.write("broken.png", "\x89PNG\r\n\x1a\nnot");
  write_file_whole(folder.path() / "large.png", std::string(2 << 20, 'x'));
  Messages messages;
  TaskQueue tasks;
  Thumbnails thumbnails;
  const auto look = [&] {
    tasks.collect(messages);
    thumbnails.update(tasks);
    for (const char* name : {"broken.png", "large.png", "missing.png"})
      EXPECT_EQ(thumbnails.of(folder.path() / name), nullptr) << name;
    return thumbnails.of(folder.path() / "new" / "good.png");
  };
  EXPECT_EQ(look(), nullptr) << "it is read away from here";
  ASSERT_TRUE(test::eventually([&] { look(); }, [&] { return !thumbnails.busy(tasks); }));
  const PictureTexture* good = look();
  ASSERT_TRUE(good);
  EXPECT_EQ(good->pixels().size(), 4u * 128 * 64);
  EXPECT_EQ(good->pixels()[4 * (128 * 10 + 5)], 0);
  EXPECT_EQ(good->pixels()[4 * (128 * 50 + 5)], 255);
}

class StartPageTest : public test::WindowFixture {
protected:
  StartPageTest() {
    ImGui::GetIO().DisplaySize = {1300, 900};
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    runs.steps = 1000000;
    frames(5);
  }
  const PresetsPanel& presets() const { return workspace.panel<PresetsPanel>(); }
  void click(const std::string& widget) { click_in(workspace.start_page(), widget, 3); }
  std::string engine() const { return workbench.preset() ? std::string(workbench.preset()->settings.engine()) : ""; }
  void listed() {
    ASSERT_TRUE(until([&] { return presets().catalogue().readings() > 0 && workbench.tasks().empty(); }));
    frames(2);
  }
};

TEST(StartPageCards, OpenTheirExamples) {
  for (const char* card : {"first-light", "environment/ball", "inverse/shapes"}) {
    test::HeadlessWindow<> window;
    window.runs.steps = 1000000;
    window.resize({1300, 900});
    window.frames(5);
    window.click_in(window.workspace.start_page(), card, 3);
    ASSERT_TRUE(window.workbench.preset());
    EXPECT_EQ(preset::shipped_name(window.workbench.preset()->source), card);
    for (const Message& message : window.workbench.messages()) EXPECT_FALSE(message.error) << message.line;
  }
}

TEST_F(StartPageTest, EachButtonDoesWhatItSays) {
  click("Open...");
  EXPECT_EQ(workbench.questions().question(), Question::open);
  apply({command::Ask{Question::none}});
  click("Commands...");
  EXPECT_EQ(workbench.questions().question(), Question::command);
  apply({command::Ask{Question::none}});
  click("New scene");
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(engine(), "spectral");
  EXPECT_TRUE(workbench.preset()->source.empty()) << "it is in no file";
  EXPECT_FALSE(workbench.preset()->scene.objects.empty());
}

TEST_F(StartPageTest, AnEarlierSessionIsOfferedWhereThereIsOne) {
  click("Reopen the last session");
  EXPECT_FALSE(workbench.questions().take_reopen()) << "there is none, and the button is grey";
  workbench.offer_earlier(true);
  frames(2);
  click("Reopen the last session");
  EXPECT_TRUE(workbench.questions().take_reopen());
}

TEST_F(StartPageTest, TypingFindsAPresetWithoutAMouse) {
  listed();
  type("environment/ball"); // the field has the keyboard from the start
  ASSERT_EQ(presets().listed().size(), 1u);
  press(ImGuiKey_Enter);
  ASSERT_TRUE(workbench.preset());
  EXPECT_EQ(workbench.preset()->name, "ball");
}

TEST_F(StartPageTest, ItsSearchLeavesKeysWithCtrlToTheirActions) {
  frames(3);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  press(ImGuiKey_O, ImGuiMod_Ctrl);
  EXPECT_EQ(workbench.questions().question(), Question::open);
  press(ImGuiKey_Escape);
  frames(3);
  press(ImGuiKey_N, ImGuiMod_Ctrl);
  EXPECT_NE(workbench.preset(), nullptr);
}

TEST_F(StartPageTest, AMessageThatComesTakesTheKeyboardFromNobody) {
  listed();
  type("environment/");
  apply({command::Report{"something went wrong"}});
  type("ball");
  EXPECT_EQ(presets().listed().size(), 1u);
}

// Tab goes from widget to widget, Space presses what is marked: the cards are reached, too.
TEST_F(StartPageTest, TabAndSpaceOpenAnExample) {
  listed();
  for (int tabs = 0; tabs < 40 && !workbench.preset(); ++tabs) {
    press(ImGuiKey_Tab);
    const auto card = workspace.start_page().place_of("inverse/shapes");
    const ImRect marked =
        ImGui::GetCurrentContext()->NavWindow
            ? ImGui::WindowRectRelToAbs(ImGui::GetCurrentContext()->NavWindow,
                                        ImGui::GetCurrentContext()->NavWindow->NavRectRel[ImGuiNavLayer_Main])
            : ImRect();
    if (!card || !marked.Contains(ImVec2(static_cast<float>((*card)[0]), static_cast<float>((*card)[1])))) continue;
    press(ImGuiKey_Space);
  }
  ASSERT_TRUE(workbench.preset()) << "Tab does not come to the third card";
  EXPECT_EQ(workbench.preset()->name, "shapes");
}

} // namespace nephroid::ui::presets_panel_test
