// SPDX-License-Identifier: Apache-2.0
// Files that other programs change while the window is open: the preset's own, and those that it names. Where a device
// was lost, it is opened again.
#include "fake_job.h"
#include "ui/state/file_watch.h"

namespace nephroid::ui::file_watch_test {

class FileWatchTest : public test::WorkbenchFixture {
protected:
  std::string file = folder.write("test.json", test::preset_text);
  const fs::path mesh = folder.path() / "a.obj";
  /// The preset's text with another seed.
  static std::string with_seed(int seed) {
    return "{\"seed\": " + std::to_string(seed) + ", " + std::string(test::preset_text).substr(1);
  }
  void open() {
    runs.steps = 100000;
    ASSERT_TRUE(workbench.open(file));
    ASSERT_TRUE(until(job::State::running));
    rest();
  }
  void open_mesh() {
    write_file_whole(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    open();
    edit([](preset::Preset& preset) {
      preset.scene.objects[0].shape.reset();
      preset.scene.objects[0].mesh = "a.obj";
    });
    rest();
  }
  /// As long as the watch takes to see everything.
  void rest() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1200);
    (void)until([&] { return std::chrono::steady_clock::now() > end; });
  }
};

TEST_F(FileWatchTest, AChangedPresetIsTakenOverAndCanBeUndone) {
  open();
  write_file_whole(file, with_seed(77));
  ASSERT_TRUE(until([&] { return workbench.preset()->seed == 77; }));
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_EQ(workbench.edits()->undo_label(), "reload test.json");
  workbench.apply({command::Undo{}});
  EXPECT_EQ(workbench.preset()->seed, 1u);
  EXPECT_TRUE(workbench.edits()->modified());
}

// However late the watch looks for the first time: here it is written ten seconds after it was read, and before that
// look.
TEST_F(FileWatchTest, WhatIsWrittenBetweenReadingAndTheFirstLookIsSeen) {
  const auto preset = std::make_shared<const preset::Preset>(preset::read_preset(file));
  fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(10));
  FileWatch watch;
  watch.watch(preset, true);
  std::vector<fs::path> changed;
  ASSERT_TRUE(test::eventually([&] { changed = watch.take_changed(); }, [&] { return !changed.empty(); }));
  EXPECT_EQ(changed, std::vector<fs::path>{file});
}

TEST_F(FileWatchTest, EditsThatAreNotSavedAreKept) {
  open();
  edit([](preset::Preset& preset) { preset.seed = 5; });
  write_file_whole(file, with_seed(77));
  ASSERT_TRUE(until([&] { return !workbench.messages().empty(); }));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("another program changed this file"));
  EXPECT_EQ(workbench.preset()->seed, 5u);
  workbench.apply({command::ReloadPreset{}});
  EXPECT_EQ(workbench.preset()->seed, 77u);
  workbench.apply({command::Undo{}});
  EXPECT_EQ(workbench.preset()->seed, 5u);
}

TEST_F(FileWatchTest, WhatTheWindowSavesItselfIsNoChange) {
  open();
  edit([](preset::Preset& preset) { preset.seed = 5; });
  workbench.apply({command::SavePreset{file}});
  const int made = runs.made;
  rest();
  EXPECT_EQ(workbench.edits()->undo_label(), "edit") << "nothing was taken over";
  EXPECT_LE(runs.made, made + 1) << "the run of the edit";
}

TEST_F(FileWatchTest, WhatIsOpenedAfterAChangeIsNotSaidToBeChanged) {
  open();
  write_file_whole(file, with_seed(77));
  ASSERT_TRUE(workbench.open(file));
  edit([](preset::Preset& preset) { preset.seed = 5; });
  rest();
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_EQ(workbench.preset()->seed, 5u);
}

TEST_F(FileWatchTest, ABrokenPresetIsSaidAndNothingIsLost) {
  open();
  write_file_whole(file, "{\"scene\": ");
  ASSERT_TRUE(until([&] { return !workbench.messages().empty(); }));
  EXPECT_THAT(workbench.messages()[0].line, StartsWith(file));
  EXPECT_EQ(workbench.preset()->seed, 1u);
}

TEST_F(FileWatchTest, AFileThatThePresetNamesStartsTheRunAgain) {
  open_mesh();
  const int made = runs.made, reread = runs.reread;
  write_file_whole(mesh, "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
  EXPECT_TRUE(until([&] { return runs.made > made; }));
  EXPECT_GT(runs.reread, reread);
  fs::remove(mesh);
  const int before = runs.made;
  rest();
  EXPECT_EQ(runs.made, before) << "a file that is gone may be on its way back";
}

TEST_F(FileWatchTest, ABrokenPresetHidesNoOtherFile) {
  open_mesh();
  const int reread = runs.reread;
  write_file_whole(file, "{\"scene\": ");
  write_file_whole(mesh, "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
  const auto said = [&] { return std::ranges::count(workbench.messages(), true, &Message::error) > 0; };
  EXPECT_TRUE(until([&] { return said() && runs.reread > reread; }));
}

TEST_F(FileWatchTest, ADeviceThatWasLostIsOpenedAgain) {
  runs.fails = true;
  ASSERT_TRUE(workbench.open(file));
  ASSERT_TRUE(until(job::State::failed));
  EXPECT_EQ(runs.reopened, 1);
  runs.fails = false;
  workbench.apply({command::Restart{}});
  EXPECT_TRUE(until(job::State::finished));
}

} // namespace nephroid::ui::file_watch_test
