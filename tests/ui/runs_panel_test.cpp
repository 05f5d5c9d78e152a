// SPDX-License-Identifier: Apache-2.0
// The panel "Runs": the table of the run in hand and of pinned runs, its buttons, and the report over them.
#include "measure/run_files.h"
#include "ui/runs/panel.h"
#include "ui/state/run_record.h"
#include "window_fixture.h"

namespace nephroid::ui::runs_panel_test {

class RunsPanelTest : public test::WindowFixture {
protected:
  RunsPanelTest() : WindowFixture("runs") { runs.plan.engine = "spectral"; }

  const RunsPanel& panel() const { return workspace.panel<RunsPanel>(); }
  void click_on(const std::string& widget) { click_in(panel(), widget); }
  void edit(const std::function<void(preset::Preset&)>& change) {
    WindowFixture::edit(change);
    ASSERT_TRUE(until_current());
    finish();
  }
  std::string difference(const RunRow& row) { return PresetDifferences().of(row, context()).in_short; }
  std::vector<PinnedRun> pins() const { return workbench.comparing().pinned().all(); }
  /// Until the report is written or refused: the newest message.
  std::string report(const std::string& file) {
    workbench.apply({command::WriteReport{file}});
    EXPECT_TRUE(until_files_are_done());
    return workbench.messages().empty() ? "" : workbench.messages().back().line;
  }
};

TEST_F(RunsPanelTest, ListsTheRunInHandAndThePinnedOnes) {
  run_measured();
  press(ImGuiKey_P);
  edit([](preset::Preset& p) {
    p.scene.lights[0].power_w = 20;
    p.scene.camera.fov_deg = 30;
  });
  frame();
  ASSERT_THAT(panel().rows(), SizeIs(2));
  const RunRow &now = panel().rows()[0], &pin = panel().rows()[1];
  EXPECT_EQ(now.name, "this run");
  EXPECT_EQ(pin.name, "Test");
  for (const RunRow& row : panel().rows()) {
    EXPECT_EQ(row.engine, "spectral");
    EXPECT_EQ(row.steps, "20 passes");
    EXPECT_EQ(row.seconds, "0.04 s");
    EXPECT_EQ(row.error, "0.0224 lab_mean") << "0.01 / sqrt(0.2): the last of 20 rows, one each 10 ms";
    EXPECT_EQ(row.error_kind, "to its reference");
  }
  EXPECT_EQ(difference(now), "as the present preset");
  EXPECT_EQ(difference(pin), "scene.camera.fov_deg: 30.0 -> 40.0, 1 more");
}

TEST_F(RunsPanelTest, WhatARunDoesNotKnowIsADash) {
  run_through();
  frame();
  ASSERT_THAT(panel().rows(), SizeIs(1));
  EXPECT_EQ(panel().rows()[0].error, "-") << "nothing is measured";
  EXPECT_EQ(panel().rows()[0].error_kind, "-");
  folder.write("old.csv", measure::to_csv(*falling_history(3)));
  workbench.apply({command::PinFile{folder.path() / "old.csv"}});
  ASSERT_TRUE(until([&] { return panel().rows().size() == 2; }));
  const RunRow& table = panel().rows()[1];
  EXPECT_EQ(table.engine, "-");
  EXPECT_EQ(table.steps, "-");
  EXPECT_EQ(table.seconds, "0.03 s") << "of its last row";
  EXPECT_EQ(table.error, "0.0577 lab_mean");
  EXPECT_EQ(difference(table), "its preset is not known");
  EXPECT_FALSE(table.has_picture);
  click_on(fmt::format("take {}", table.pin));
  EXPECT_FALSE(workbench.edits()->modified()) << "the button is grey";
}

TEST_F(RunsPanelTest, AnEstimateIsCalledOne) {
  runs.history = [](int steps) {
    auto history = falling_history(steps);
    history->error_column = "estimated_lab_mean";
    return history;
  };
  run_through();
  frame();
  EXPECT_EQ(panel().rows()[0].error, "0.0246 lab_mean");
  EXPECT_EQ(panel().rows()[0].error_kind, "estimate");
}

TEST_F(RunsPanelTest, ShowsARunInTheView) {
  run_through();
  press(ImGuiKey_P);
  edit([](preset::Preset& p) { p.scene.camera.position[2] = 0; });
  const std::string show = fmt::format("show {}", pins()[0].id);
  click_on(show);
  EXPECT_EQ(workbench.comparing().comparison().shown, pins()[0].id);
  frames(2);
  EXPECT_EQ(view().shown().label, "\"Test\"");
  click_on("show 0");
  EXPECT_EQ(workbench.comparing().comparison().shown, 0u);
  click_on(show);
  click_on(show);
  EXPECT_EQ(workbench.comparing().comparison().shown, 0u) << "pressed again, back";
}

TEST_F(RunsPanelTest, TakesTheTakenPresetAsOneEdit) {
  run_through();
  press(ImGuiKey_P);
  edit([](preset::Preset& p) {
    p.name = "Other";
    p.scene.lights[0].power_w = 20;
  });
  click_on(fmt::format("take {}", pins()[0].id));
  EXPECT_EQ(workbench.preset()->scene.lights[0].power_w, 10);
  EXPECT_EQ(workbench.preset()->name, "Other") << "it is of the same file";
  EXPECT_EQ(workbench.edits()->undo_label(), "take the preset of Test");
  workbench.apply({command::Undo{}});
  EXPECT_EQ(workbench.preset()->scene.lights[0].power_w, 20);
}

TEST_F(RunsPanelTest, PinsAndUnpins) {
  run_through();
  click_on("pin");
  ASSERT_THAT(pins(), SizeIs(1));
  click_on(fmt::format("unpin {}", pins()[0].id));
  EXPECT_THAT(pins(), SizeIs(0));
  frame();
  EXPECT_THAT(panel().rows(), SizeIs(1));
}

TEST_F(RunsPanelTest, TheReportIsOverAllFinishedRuns) {
  run_measured();
  press(ImGuiKey_P);
  edit([](preset::Preset& p) { p.scene.lights[0].power_w = 20; });
  EXPECT_THAT(report((folder.path() / "page.html").string()), HasSubstr("a report over 2 runs"));
  const std::string page = read_file(folder.path() / "page.html");
  EXPECT_THAT(page, HasSubstr("lab_mean"));
  EXPECT_THAT(page, HasSubstr("Test: edit"));
  const auto first = folder.path() / "page-runs" / "01-Test";
  EXPECT_TRUE(is_there(first / "image.png"));
  EXPECT_EQ(preset::read_preset((first / "preset.json").string()).scene.lights[0].power_w, 10);
  EXPECT_EQ(preset::read_preset((folder.path() / "page-runs" / "02-Test--edit" / "preset.json").string())
                .scene.lights[0]
                .power_w,
            20);
  // Once more: nothing is written over, and a run that is pinned as it stands is in the page once.
  press(ImGuiKey_P);
  EXPECT_THAT(report((folder.path() / "page.html").string()), HasSubstr("a report over 2 runs"));
  EXPECT_TRUE(is_there(folder.path() / "page-runs-2" / "02-Test--edit" / "run.json"));
}

TEST_F(RunsPanelTest, ADialogAsksForTheReportsName) {
  run_measured();
  click_on("report");
  ASSERT_EQ(workbench.questions().question(), Question::save_report);
  frames(3);
  retype(folder.path() / "asked.html");
  press(ImGuiKey_Enter);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_TRUE(until([&] { return is_there(folder.path() / "asked.html"); }));
}

TEST_F(RunsPanelTest, AReportSaysWhatItLeavesOutAndWhy) {
  run_measured();
  press(ImGuiKey_P);
  folder.write("old.csv", measure::to_csv(*falling_history(3)));
  workbench.apply({command::PinFile{folder.path() / "old.csv"}});
  ASSERT_TRUE(until([&] { return pins().size() == 2; }));
  const std::string note = report((folder.path() / "page.html").string());
  EXPECT_THAT(note, HasSubstr("over 1 run;"));
  EXPECT_THAT(note, HasSubstr("left out: \"old\": only its history was read"));
}

TEST_F(RunsPanelTest, WithoutAFinishedRunThereIsNoReport) {
  runs.steps = 1000000;
  open();
  const std::string line = report((folder.path() / "page.html").string());
  EXPECT_THAT(line, HasSubstr("page.html: there is no run for a report (\"Test\": it is not finished)"));
  EXPECT_TRUE(workbench.messages().back().error);
  EXPECT_FALSE(is_there(folder.path() / "page.html"));
  EXPECT_FALSE(is_there(folder.path() / "page-runs"));
}

TEST_F(RunsPanelTest, AReportThatCannotBeWrittenLeavesNothing) {
  run_measured();
  EXPECT_THAT(report((folder.path() / "page.txt").string()), HasSubstr("expected a name that ends in .html"));
  folder.write("file", "no folder");
  EXPECT_THAT(report((folder.path() / "file" / "page.html").string()), HasSubstr("file/page"));
  EXPECT_TRUE(workbench.messages().back().error);
  EXPECT_FALSE(is_there(folder.path() / "page-runs"));
  // A page that cannot be written where a folder is takes what was written beside it along, and nothing that was there.
  const auto of_others = folder.path() / "page-runs";
  fs::create_directory_symlink("a disk that is not there now", of_others);
  fs::create_directories(folder.path() / "page.html");
  EXPECT_THAT(report((folder.path() / "page.html").string()), HasSubstr("page.html"));
  EXPECT_TRUE(workbench.messages().back().error);
  EXPECT_TRUE(fs::is_symlink(of_others));
  EXPECT_FALSE(is_there(folder.path() / "page-runs-2"));
}

TEST_F(RunsPanelTest, AFolderOpensItsPresetWhereNoneIsOpen) {
  run_measured();
  const std::string run = folder.path() / "before";
  write_run_folder(run, run_now(workbench.run()), "before", true);
  Workbench other(runs);
  other.apply({command::Open{run}});
  ASSERT_NE(other.preset(), nullptr);
  EXPECT_EQ(other.preset()->source, run + "/preset.json");
  edit([](preset::Preset& p) { p.scene.lights[0].power_w = 20; });
  workbench.apply({command::Open{run}});
  EXPECT_EQ(workbench.preset()->scene.lights[0].power_w, 20) << "what is open stays";
}

TEST_F(RunsPanelTest, AFolderThatWasReadIsTakenAsItIs) {
  run_measured();
  write_run_folder(folder.path() / "before", run_now(workbench.run()), "before", true);
  workbench.apply({command::PinFile{folder.path() / "before"}});
  ASSERT_TRUE(until([&] { return pins().size() == 1; }));
  frame();
  const RunRow row = panel().rows()[1];
  EXPECT_EQ(row.engine, "spectral");
  EXPECT_EQ(row.steps, "20 passes");
  EXPECT_EQ(difference(row), "as the present preset") << "the name is none";
  edit([](preset::Preset& p) { p.scene.lights[0].power_w = 20; });
  EXPECT_EQ(difference(row), "scene.lights.0.power_w: 20.0 -> 10.0");
  EXPECT_THAT(report((folder.path() / "page.html").string()), HasSubstr("over 2 runs"));
  EXPECT_FALSE(is_there(folder.path() / "page-runs" / "01-before"));
  EXPECT_TRUE(is_there(folder.path() / "page-runs" / "02-Test--edit"));
  // The folder is gone: what was read of it is written.
  fs::remove_all(folder.path() / "before");
  EXPECT_THAT(report((folder.path() / "page.html").string()), HasSubstr("over 2 runs"));
  EXPECT_TRUE(is_there(folder.path() / "page-runs-2" / "01-before" / "image.exr"));
}

TEST_F(RunsPanelTest, ASessionKeepsWhatIsKnownOfAPin) {
  run_measured();
  press(ImGuiKey_P);
  test::Bench next;
  reopen_in(next.workbench);
  ASSERT_TRUE(next.until([&] { return next.workbench.comparing().pinned().all().size() == 1; }));
  const PinnedRun pin = next.workbench.comparing().pinned().all()[0];
  EXPECT_EQ(pin.name, "Test");
  ASSERT_TRUE(pin.record && pin.record->preset);
  EXPECT_EQ(pin.record->engine, "spectral");
  EXPECT_EQ(pin.record->steps, 20);
  EXPECT_TRUE(pin.record->finished);
  EXPECT_EQ(pin.record->preset->scene.lights[0].power_w, 10);
  EXPECT_EQ(why_no_folder(pin), "");
  EXPECT_THAT(write_report(folder.path() / "later.html", std::span(&pin, 1)), HasSubstr("over 1 run"));
}

TEST_F(RunsPanelTest, ADamagedFolderIsSaidOnce) {
  open();
  const auto bad = folder.path() / "bad";
  fs::create_directories(bad);
  write_file_whole(bad / "history.csv", measure::to_csv(*falling_history(3)));
  write_file_whole(bad / "run.json", "{\"engine\": 7, \"units\": [], \"work_seconds\": \"long\", \"finished\": 1}");
  write_file_whole(bad / "preset.json", "{\"engine\": \"none of ours\"}");
  workbench.apply({command::PinFile{bad}});
  ASSERT_TRUE(until([&] { return panel().rows().size() == 2; }));
  EXPECT_EQ(panel().rows()[1].engine, "-");
  EXPECT_EQ(panel().rows()[1].seconds, "-");
  EXPECT_EQ(difference(panel().rows()[1]), "its preset is not known");
  EXPECT_THAT(workbench.messages(), SizeIs(0));
}

} // namespace nephroid::ui::runs_panel_test
