// SPDX-License-Identifier: Apache-2.0
// The workbench with a job of the test's own and the program's real worker thread: commands in, preset, picture and
// messages out.
#include "fake_job.h"

namespace nephroid::ui::workbench_test {

using namespace std::chrono_literals;

class WorkbenchTest : public test::WorkbenchFixture {
protected:
  void edit_z(double z, std::uint64_t gesture = 0, bool live = false) {
    edit([&](preset::Preset& p) { p.scene.camera.position = {0, 0, z}; }, gesture, live);
  }
  /// A run that does not end, until it shows a picture.
  void open_endless() {
    runs.steps = 100000;
    open();
    ASSERT_TRUE(until([&] { return workbench.run().snapshot() != nullptr; }));
  }
  bool shows_z(float z) {
    return until([&] { return picture_z() == z; });
  }
  float picture_z() const { return workbench.run().snapshot() ? workbench.run().snapshot()->picture->rgb[2] : -1; }
};

TEST_F(WorkbenchTest, OpensRunsAndFinishes) {
  EXPECT_EQ(workbench.preset(), nullptr);
  open();
  EXPECT_EQ(workbench.preset()->name, "Test");
  ASSERT_TRUE(until(job::State::finished));
  EXPECT_EQ(workbench.run().status().progress.fraction, 1);
  EXPECT_EQ(workbench.run().snapshot()->picture->width, 64);
  EXPECT_EQ(workbench.run().snapshot()->progress.step, 20) << "a finished run shows its last picture";
  EXPECT_TRUE(workbench.run().snapshot_is_current());
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(WorkbenchTest, OverridesApplyToWhatIsOpened) {
  ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text), {"seed=42"}));
  EXPECT_EQ(workbench.preset()->seed, 42u);
  EXPECT_TRUE(workbench.preset()->provenance.origins);
  edit_z(2);
  EXPECT_FALSE(workbench.preset()->provenance.origins) << "what an edit breaks is not the override's fault";
}

TEST_F(WorkbenchTest, AnEditStartsANewRunAndKeepsTheOldPictureUntilThen) {
  run_through();
  runs.make_ms = 50;
  edit_z(2);
  workbench.update();
  EXPECT_EQ(runs.made, 1);
  EXPECT_EQ(picture_z(), 4) << "the last image stays";
  EXPECT_FALSE(workbench.run().snapshot_is_current());
  EXPECT_TRUE(workbench.run().snapshot_is_previous()) << "and is marked";
  ASSERT_TRUE(shows_z(2));
  EXPECT_TRUE(workbench.run().snapshot_is_current());
  EXPECT_FALSE(workbench.run().snapshot_is_previous());
  EXPECT_EQ(runs.made, 2);
}

// The wheel turned for too long, "nan" typed into a field: the preset could be neither saved nor opened again.
TEST_F(WorkbenchTest, AnEditOutOfRangeIsRefusedInOneMessage) {
  run_through();
  for (const double z : {1e8, 2e8, std::nan("")}) edit_z(z, 1, true);
  workbench.update();
  EXPECT_THAT(only_message(workbench), HasSubstr("test.json#/scene/camera/position/2: is null; expected a number"));
  EXPECT_EQ(workbench.preset()->scene.camera.position[2], 4);
  EXPECT_EQ(workbench.edits()->state().entries.size(), 1u);
  EXPECT_EQ(runs.made, 1);
  edit_z(2);
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_EQ(workbench.preset()->scene.camera.position[2], 2);
}

TEST_F(WorkbenchTest, PartsOfAPictureHideAWholeOneOnlyWhereTheRunIsSlow) {
  runs.whole_from = runs.steps = 100000;
  open();
  ASSERT_TRUE(shows_z(4));
  EXPECT_FALSE(workbench.run().snapshot()->progress.whole) << "parts are better than nothing";
  runs.whole_from = 2;
  runs.step_ms = 20; // a snapshot after the first step, and then each 100 ms
  edit_z(2);
  ASSERT_TRUE(shows_z(2));
  EXPECT_TRUE(workbench.run().snapshot()->progress.whole);
  runs.whole_from = 100000;
  edit_z(3);
  ASSERT_TRUE(shows_z(3));
  EXPECT_FALSE(workbench.run().snapshot()->progress.whole) << "what there is of it after a second";
}

TEST_F(WorkbenchTest, AnEditReplacesARunningJob) {
  open_endless();
  edit_z(3);
  ASSERT_TRUE(until([&] { return runs.made == 2; })) << "the old job's steps would go on for hours";
}

TEST_F(WorkbenchTest, DuringAGestureEveryRunShowsAPictureBeforeTheNextReplacesIt) {
  open_endless();
  runs.make_ms = 20; // slower than the mouse moves
  int pictures = 0;
  double z = 3;
  std::shared_ptr<const job::Snapshot> last = workbench.run().snapshot();
  const auto move = [&] {
    edit_z(z += 0.001, 1, true);
    workbench.update();
    if (workbench.run().snapshot() != last) ++pictures;
    last = workbench.run().snapshot();
    std::this_thread::sleep_for(3ms);
  };
  ASSERT_TRUE(eventually(move, [&] { return pictures >= 4; })) << "something is seen while the mouse moves";
  workbench.apply({command::EndGesture{}});
  ASSERT_TRUE(shows_z(static_cast<float>(z)));
  workbench.apply({command::Undo{}});
  EXPECT_EQ(workbench.preset()->scene.camera.position[2], 4) << "the gesture is one entry";
}

TEST_F(WorkbenchTest, UndoAndRedoRunAgain) {
  open();
  edit_z(2);
  ASSERT_TRUE(shows_z(2));
  workbench.apply({command::Undo{}});
  ASSERT_TRUE(shows_z(4));
  workbench.apply({command::Redo{}});
  ASSERT_TRUE(shows_z(2));
}

TEST_F(WorkbenchTest, CancelAndPauseHoldTheRun) {
  runs.steps = 100000;
  open();
  ASSERT_TRUE(until(job::State::running));
  workbench.apply({command::Pause{true}});
  ASSERT_TRUE(until(job::State::paused));
  workbench.apply({command::Pause{false}});
  ASSERT_TRUE(until(job::State::running));
  workbench.apply({command::Cancel{}});
  ASSERT_TRUE(until(job::State::cancelled));
  EXPECT_NE(workbench.run().snapshot(), nullptr) << "its picture stays";
  workbench.apply({command::Restart{}});
  ASSERT_TRUE(until(job::State::running));
  EXPECT_EQ(runs.made, 2);
}

TEST_F(WorkbenchTest, AFailureIsOneMessageUntilTheNextRun) {
  runs.fails = true;
  open();
  ASSERT_TRUE(until(job::State::failed));
  for (int i = 0; i < 5; ++i) workbench.update();
  EXPECT_EQ(only_message(workbench), "clEnqueueNDRangeKernel: the device is gone; start again");
  EXPECT_TRUE(workbench.messages()[0].error);
  runs.fails = false;
  workbench.apply({command::Restart{}});
  EXPECT_TRUE(workbench.messages().empty());
  ASSERT_TRUE(until(job::State::finished));
}

TEST_F(WorkbenchTest, ChangedKernelsStartTheRunAgainAndKeepThePictureWhereTheyDoNotCompile) {
  run_through();
  runs.broken = runs.changed = true;
  ASSERT_TRUE(until(job::State::failed));
  workbench.update();
  EXPECT_EQ(only_message(workbench), "photons.cl:12: expected ';' after expression");
  EXPECT_EQ(picture_z(), 4) << "the last picture stays";
  for (int i = 0; i < 5; ++i) workbench.update();
  EXPECT_EQ(runs.made, 2) << "a change is one attempt";
  runs.broken = false;
  runs.changed = true;
  ASSERT_TRUE(until(job::State::finished));
  EXPECT_TRUE(workbench.messages().empty());
  EXPECT_TRUE(workbench.run().snapshot_is_current());
  EXPECT_EQ(runs.made, 3);
}

TEST_F(WorkbenchTest, NotesAreTheProgramsAndThoseOfThePlan) {
  workbench.add_note("kernels are kept elsewhere");
  EXPECT_THAT(workbench.notes(), ElementsAre("kernels are kept elsewhere"));
  run_through();
  EXPECT_THAT(workbench.notes(), ElementsAre("kernels are kept elsewhere", "Test: n is extrapolated below 390 nm"));
  edit_z(2);
  ASSERT_TRUE(shows_z(2));
  EXPECT_EQ(workbench.notes().size(), 2u) << "the same note of the next run is not another one";
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(WorkbenchTest, AFileThatCannotBeOpenedLeavesWhatIsThereAlone) {
  open();
  const std::string broken = folder.write("broken.json", R"({"engine": "spectral", "sceen": {}})");
  workbench.apply({command::Open{broken}});
  EXPECT_EQ(workbench.preset()->name, "Test");
  EXPECT_THAT(only_message(workbench), HasSubstr("sceen"));
  workbench.apply({command::Dismiss{workbench.messages()[0].id}});
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(WorkbenchTest, ADialogStaysUntilAFileIsTaken) {
  open();
  workbench.apply({command::Ask{Question::open}, command::Open{"no-such-file.obj.json"}});
  EXPECT_EQ(workbench.questions().question(), Question::open) << "the name can be typed anew";
  const Message once = workbench.messages().back();
  workbench.apply({command::Open{"no-such-file.obj.json"}});
  EXPECT_EQ(workbench.messages().back().id, once.id) << "it is one message, and can be dismissed";
  EXPECT_GT(workbench.messages().back().said, once.said) << "the dialog says it again";
  workbench.apply({command::Open{folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}});
  EXPECT_EQ(workbench.questions().question(), Question::none);
}

TEST_F(WorkbenchTest, ANewPresetIsCalledAsItIsSavedAndItsRunGoesOn) {
  open();
  preset::Preset untitled = *workbench.preset();
  untitled.name = "untitled";
  workbench.apply({command::Edit{"name", untitled}});
  ASSERT_TRUE(until([&] { return workbench.run().snapshot() != nullptr; }));
  const int runs_before = runs.made;
  workbench.apply({command::SavePreset{folder.path() / "table.json"}});
  EXPECT_EQ(workbench.preset()->name, "table");
  EXPECT_EQ(preset::read_preset((folder.path() / "table.json").string()).name, "table");
  EXPECT_EQ(runs.made, runs_before) << "a name changes no light";
  EXPECT_TRUE(workbench.run().snapshot_is_current());
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(WorkbenchTest, ASavedPresetReadsBackAsWhatWasOnTheScreen) {
  open();
  edit_z(2.5);
  EXPECT_TRUE(workbench.edits()->modified());
  EXPECT_EQ(save_target(workbench.preset()), folder.path() / "test.json");
  workbench.apply({command::SavePreset{folder.path() / "other.json"}});
  EXPECT_FALSE(workbench.edits()->modified());
  const preset::Preset saved = preset::read_preset((folder.path() / "other.json").string());
  EXPECT_EQ(preset::to_json(saved), preset::to_json(*workbench.preset()));
  EXPECT_EQ(saved.scene.camera.position[2], 2.5);
  EXPECT_EQ(save_target(workbench.preset()), folder.path() / "other.json");
}

TEST_F(WorkbenchTest, ThePictureIsWrittenInTheBackground) {
  run_through();
  workbench.apply({command::SavePicture{folder.path() / "a.png"}, command::SavePicture{folder.path() / "a.gif"}});
  ASSERT_TRUE(until([&] { return workbench.messages().size() == 2; }));
  EXPECT_TRUE(fs::file_size(folder.path() / "a.png") > 0);
  EXPECT_FALSE(fs::exists(folder.path() / "a.gif"));
  EXPECT_EQ(std::ranges::count_if(workbench.messages(), &Message::error), 1);
  workbench.update(Workbench::Clock::now() + 1h);
  EXPECT_EQ(workbench.messages().size(), 1u) << "notes go by themselves, errors stay";
}

TEST_F(WorkbenchTest, WhatIsBeingWrittenAtTheEndIsWaitedFor) {
  run_through();
  workbench.apply(
      {command::SavePicture{folder.path() / "a.PNG"}, command::SavePicture{folder.path() / "missing" / "b.png"}});
  workbench.finish_files();
  EXPECT_TRUE(fs::exists(folder.path() / "a.PNG"));
  EXPECT_EQ(std::ranges::count_if(workbench.messages(), &Message::error), 1) << "the folder is missing";
}

TEST_F(WorkbenchTest, WhatWaitsForAnAnswerGoesWithItsQuestion) {
  open();
  edit_z(2);
  workbench.apply({command::Quit{}});
  ASSERT_EQ(workbench.questions().question(), Question::unsaved);
  workbench.apply({command::PinFile{folder.path() / "dropped.csv"}});
  EXPECT_EQ(workbench.questions().question(), Question::none);
  workbench.apply({command::SavePreset{folder.path() / "other.json"}});
  EXPECT_FALSE(workbench.questions().quitting()) << "nobody answered that the window may close";
}

} // namespace nephroid::ui::workbench_test
