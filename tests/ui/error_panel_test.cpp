// SPDX-License-Identifier: Apache-2.0
// The panel "Error": what it plots of any history, how its axes follow, what it copies; the lines of a history and
// pinned runs, without a window.
#include "fake_job.h"
#include "image/image.h"
#include "measure/run_curves.h"
#include "measure/run_files.h"
#include "ui/error/lines.h"
#include "window_fixture.h"

namespace nephroid::ui::error_panel_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class ErrorPanelTest : public test::WindowFixture {
protected:
  const ErrorPanel& panel() const { return workspace.panel<ErrorPanel>(); }
  void hover(const std::array<double, 4>& area) {
    imgui.move(area[0] + area[2] / 2, area[1] + area[3] / 2);
    frame();
  }
};

TEST_F(ErrorPanelTest, ThePlotFollowsTheRunInHand) {
  frames(3);
  EXPECT_TRUE(panel().contents().runs.empty()) << "nothing is open";
  run_measured();
  const PlotContents& contents = panel().contents();
  EXPECT_EQ(contents.metric, "lab_mean");
  ASSERT_THAT(contents.runs, SizeIs(1));
  EXPECT_EQ(contents.runs[0].lines->error.curve.seconds.size(), 20u);
  const PlotRange& shown = panel().plot().shown();
  EXPECT_LT(shown.seconds[0], 0.01);
  EXPECT_GT(shown.seconds[1], 0.2);
  apply({command::ChooseMetric{"rel_mse"}});
  EXPECT_EQ(panel().contents().metric, "rel_mse");
  apply({command::ChooseMetric{"flip"}});
  EXPECT_EQ(panel().contents().metric, "lab_mean") << "no run has that one";
}

TEST_F(ErrorPanelTest, HistoriesOfAnyKindAreDrawn) {
  const auto all_of = [](double error) {
    auto history = falling_history(5);
    for (job::HistoryRow& row : history->rows) row.errors = {error, error, error};
    return history;
  };
  auto same = all_of(1); // and all at one time
  for (job::HistoryRow& row : same->rows) row.seconds = 1;
  auto psnr = falling_history(5);
  psnr->columns = {"psnr_db", "iw_ssim", "estimated_lab_mean"};
  psnr->error_column = "psnr_db";
  auto floor = falling_history(50);
  floor->noise_floor = {0.02, nan, nan};
  floor->target = 0.03;
  runs.steps = 2;
  for (const auto& history : {std::make_shared<job::History>(), falling_history(0), falling_history(1), all_of(nan),
                              same, all_of(0), psnr, floor}) {
    runs.history = [&](int) { return history; };
    run_through();
    apply({command::PinRun{}});
    hover(panel().plot().area());
    EXPECT_TRUE(workbench.messages().empty());
    EXPECT_EQ(workbench.run().error_history(), history);
  }
  EXPECT_EQ(panel().contents().target, 0.03);
  apply({command::ChooseMetric{"psnr_db"}});
  EXPECT_EQ(panel().contents().metric, "psnr_db");
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(ErrorPanelTest, TenThousandRowsAreDrawnWithFewPoints) {
  const auto history = falling_history(10000);
  runs.steps = 2;
  runs.history = [&](int) { return history; };
  run_through();
  for (int i = 0; i < 5; ++i) workbench.apply({command::PinRun{}});
  frames(2);
  // What a frame costs goes by what it draws: 60000 rows unthinned would be 480000 corners and more, not 29000.
  ASSERT_NE(ImGui::GetDrawData(), nullptr);
  EXPECT_LT(ImGui::GetDrawData()->TotalVtxCount, 60000);
}

TEST_F(ErrorPanelTest, TheWheelLetsTheAxesGoAndADoubleClickTakesThemBack) {
  run_measured();
  const PlotRange before = panel().plot().shown();
  hover(panel().plot().area());
  for (int i = 0; i < 3; ++i) {
    imgui.wheel(1);
    frame();
  }
  frames(2);
  EXPECT_FALSE(panel().plot().follows());
  EXPECT_GT(panel().plot().shown().seconds[0], before.seconds[0]);
  EXPECT_EQ(camera().position[2], 4) << "the wheel over the plot is the plot's";
  for (int click = 0; click < 2; ++click) {
    imgui.button(0, true);
    frame();
    let_go();
  }
  frames(2);
  EXPECT_TRUE(panel().plot().follows());
  EXPECT_NEAR(panel().plot().shown().seconds[0], before.seconds[0], 1e-9);
}

TEST(ErrorLines, HaveAMetricsErrorItsEstimateAndTheirSlopes) {
  const auto history = falling_history(100);
  EXPECT_THAT(measure::metric_names(*history), ElementsAre("lab_mean", "rel_mse"));
  const RunLines lab = lines_of(*history, "lab_mean");
  ASSERT_EQ(lab.error.curve.seconds.size(), 100u);
  EXPECT_DOUBLE_EQ(lab.estimate.curve.errors[0], 1.1 * lab.error.curve.errors[0]);
  ASSERT_TRUE(lab.error.fit && lab.estimate.fit);
  EXPECT_NEAR(lab.error.fit->exponent, -0.5, 1e-12) << "error = level / sqrt(t)";
  const RunLines mse = lines_of(*history, "rel_mse");
  ASSERT_TRUE(mse.error.fit);
  EXPECT_NEAR(mse.error.fit->exponent, -1, 1e-12);
  EXPECT_TRUE(mse.estimate.curve.seconds.empty());
  EXPECT_TRUE(lines_of(*history, "flip").empty());
}

TEST(ErrorLines, AnEstimateAloneIsWhatARunIsJudgedBy) {
  job::History history{.columns = {"estimated_lab_mean"}, .rows = {{1, 1, 1, 10, {0.5}}}};
  EXPECT_THAT(measure::metric_names(history), ElementsAre("lab_mean"));
  EXPECT_THAT(lines_of(history, "lab_mean").judged().curve.errors, ElementsAre(0.5));
}

TEST(ErrorLines, WhatHasNoLogarithmIsLeftOut) {
  job::History history{.columns = {"psnr_db"},
                       .rows = {{0, 0, 0, 0, {1}},
                                {1, 1, 1, 10, {nan}},
                                {2, 2, 2, 20, {0}},
                                {3, 3, 3, 30, {-4}},
                                {4, 4, 4, 40, {}},
                                {5, 5, 5, 50, {7}}}};
  EXPECT_THAT(lines_of(history, "psnr_db").error.curve.seconds, ElementsAre(2, 3, 5)) << "on a linear axis";
  history.columns = {"lab_mean"};
  EXPECT_THAT(lines_of(history, "lab_mean").error.curve.seconds, ElementsAre(5)) << "on a logarithmic one";
  EXPECT_TRUE(lines_of(job::History{}, "").empty());
}

TEST(ErrorLines, AtTheNoiseFloorNothingIsFitted) {
  // error^2 = 0.01^2 / t + floor^2: below three floors the curve bends, and its slope over all rows is flatter.
  auto history = falling_history(3000, 0.01);
  history->noise_floor = {0.004, nan, nan};
  for (job::HistoryRow& row : history->rows) row.errors[0] = std::hypot(row.errors[0], 0.004);
  const RunLines lines = lines_of(*history, "lab_mean");
  ASSERT_TRUE(lines.noise_floor && lines.error.fit);
  EXPECT_NEAR(lines.error.fit->exponent, -0.5, 0.05);
  EXPECT_GT(measure::fit_power_law(lines.error.curve)->exponent, -0.43);
  EXPECT_FALSE(lines_of(*history, "rel_mse").noise_floor) << "its floor is not known";
}

TEST(ErrorLines, ManyRowsAreThinnedButKeepTheirExtremes) {
  auto history = falling_history(10000);
  history->rows[5000].errors[0] = 7;
  history->rows[6000].errors[0] = 1e-9;
  const ErrorLine line = lines_of(*history, "lab_mean").error;
  EXPECT_EQ(line.curve.seconds.size(), 10000u);
  EXPECT_LE(line.drawn.seconds.size(), 4u * 501);
  EXPECT_TRUE(std::is_sorted(line.drawn.seconds.begin(), line.drawn.seconds.end()));
  EXPECT_THAT(line.drawn.errors, IsSupersetOf({7.0, 1e-9}));
  EXPECT_EQ(line.drawn.seconds.back(), line.curve.seconds.back());
}

TEST(ErrorLines, SpeedUpIsTheRatioOfTimesAtEqualError) {
  // Half the error at every time is a quarter of the time to an error: error = level / sqrt(t), t = (level / error)^2.
  const RunLines slow = lines_of(*falling_history(100, 0.02), "lab_mean"),
                 fast = lines_of(*falling_history(100, 0.01), "lab_mean");
  const auto equal = speed_up(slow, fast);
  ASSERT_TRUE(equal);
  EXPECT_NEAR(equal->speed_up(), 4, 1e-9);
  EXPECT_NEAR(equal->error, 0.02, 1e-12) << "the lowest that the slow one came to, at 1 s";
  EXPECT_FALSE(equal->by_estimate);
  EXPECT_NEAR(speed_up(fast, slow)->speed_up(), 0.25, 1e-9);
  EXPECT_FALSE(speed_up(slow, RunLines{}));
  RunLines other = fast;
  other.error = {};
  ASSERT_TRUE(speed_up(slow, other));
  EXPECT_TRUE(speed_up(slow, other)->by_estimate);
  other.estimate = {};
  EXPECT_FALSE(speed_up(slow, other));
}

TEST(ErrorLines, TheNearestRowIsNearestInLogTime) {
  const measure::Curve curve{{1, 10, 100}, {3, 2, 1}};
  EXPECT_EQ(nearest_point(curve, 0.001)->seconds, 1);
  EXPECT_EQ(nearest_point(curve, 3.1)->seconds, 1);
  EXPECT_EQ(nearest_point(curve, 3.2)->seconds, 10); // the middle is sqrt(10) = 3.16
  EXPECT_EQ(nearest_point(curve, 1e9)->error, 1);
  EXPECT_FALSE(nearest_point({}, 1));
}

TEST(ErrorLines, AxesHoldEveryPointAndTheTarget) {
  const RunLines lines = lines_of(*falling_history(100, 0.01), "lab_mean");
  const RunLines* runs[] = {&lines};
  const double levels[] = {1e-4, nan};
  const PlotRange range = plot_range(runs, levels);
  EXPECT_LT(range.seconds[0], 0.01);
  EXPECT_GT(range.seconds[1], 1);
  EXPECT_LT(range.errors[0], 1e-4);
  EXPECT_GT(range.errors[1], 0.11);
  const PlotRange none = plot_range({}, {});
  EXPECT_LT(none.seconds[0], none.seconds[1]);
  job::History one{.columns = {"lab_mean"}, .rows = {{1, 1, 1, 10, {0.5}}}};
  const RunLines dot = lines_of(one, "lab_mean");
  const RunLines* dots[] = {&dot};
  const PlotRange about = plot_range(dots, {});
  EXPECT_LT(about.errors[0], 0.5);
  EXPECT_GT(about.errors[1], 0.5);
}

TEST(ErrorLines, CopyAsCsv) {
  job::History history{.columns = {"lab_mean", "estimated_lab_mean"},
                       .rows = {{1.5, 2, 1, 10, {0.5, nan}}, {3, 4, 2, 20, {0.25, 0.3}}},
                       .noise_floor = {0.125, nan}};
  const NamedLines named[] = {{"a \"b\"", lines_of(history, "lab_mean")}};
  EXPECT_EQ(plot_csv(named, 0.0625),
            "run,line,seconds,error\n"
            "\"a \"\"b\"\"\",error,1.5,0.5\n\"a \"\"b\"\"\",error,3,0.25\n\"a \"\"b\"\"\",estimate,3,0.3\n"
            "\"a \"\"b\"\"\",noise floor,,0.125\n,target,,0.0625\n");
}

TEST(PinnedRuns, HaveNamesAndColoursOfTheirOwn) {
  PinnedRuns runs;
  for (int i = 0; i < 9; ++i) runs.add({0, "glass", 0, true, falling_history(1), nullptr});
  EXPECT_EQ(runs.all()[0].name, "glass");
  EXPECT_EQ(runs.all()[1].name, "glass (2)");
  EXPECT_EQ(runs.all()[8].name, "glass (9)");
  std::set<std::uint32_t> colours;
  for (int i = 0; i < 7; ++i) colours.insert(runs.all()[static_cast<std::size_t>(i)].colour);
  EXPECT_EQ(colours.size(), 7u);
  runs.change(2, "glass", 0xff112233, false);
  EXPECT_EQ(runs.find(2)->name, "glass (2)") << "the first has that name; its own is free";
  EXPECT_FALSE(runs.find(2)->shown);
  runs.change(2, "", 0xff112233, true);
  EXPECT_EQ(runs.find(2)->colour, 0xff112233);
  runs.remove(2);
  runs.remove(77);
  EXPECT_EQ(runs.find(2), nullptr);
  EXPECT_EQ(runs.all().size(), 8u);
}

TEST(PinnedRuns, AreReadFromAFolderWithItsPicture) {
  test::TemporaryFolder folder;
  const auto history = falling_history(3);
  folder.write("history.csv", measure::to_csv(*history));
  EXPECT_TRUE(is_history(folder.path()));
  EXPECT_TRUE(is_history(folder.path() / "history.csv"));
  EXPECT_FALSE(is_history(folder.path() / "preset.json"));
  EXPECT_EQ(read_pin(folder.path()).picture, nullptr) << "there is no image.exr";
  image::write_exr(folder.path() / "image.exr", {2, 1, {"R", "G", "B", "direct.R"}, {1, 2, 3, 9, 4, 5, 6, 9}, {}});
  for (const auto& path : {folder.path(), folder.path() / "history.csv"}) {
    const PinnedRun run = read_pin(path);
    EXPECT_EQ(run.name, folder.path().filename().string());
    EXPECT_EQ(run.history->rows, history->rows);
    ASSERT_NE(run.picture, nullptr);
    EXPECT_EQ(run.picture->width, 2);
    EXPECT_THAT(run.picture->rgb, ElementsAre(1, 2, 3, 4, 5, 6));
  }
}

TEST(PinnedRuns, TheNoiseFloorOfARunsFolderIsRead) {
  test::TemporaryFolder folder;
  auto history = falling_history(3000, 0.01);
  for (job::HistoryRow& row : history->rows) row.errors[0] = std::hypot(row.errors[0], 0.004);
  folder.write("history.csv", measure::to_csv(*history));
  EXPECT_TRUE(read_pin(folder.path()).history->noise_floor.empty()) << "there is no run.json";
  folder.write(
      "run.json",
      R"({"finished": false, "reference": {"origin": "r.exr", "noise_floor": {"lab_mean": 0.004, "mse": 1}}})");
  const PinnedRun run = read_pin(folder.path());
  EXPECT_EQ(run.history->noise_floor.at(0), 0.004);
  EXPECT_TRUE(std::isnan(run.history->noise_floor.at(1)) && std::isnan(run.history->noise_floor.at(2)));
  EXPECT_NEAR(lines_of(*run.history, "lab_mean").error.fit->exponent, -0.5, 0.05);
  EXPECT_GT(lines_of(*history, "lab_mean").error.fit->exponent, -0.43)
      << "without the floor the curve's bend is fitted";
  folder.write("run.json", R"({"finished": true})");
  EXPECT_TRUE(read_pin(folder.path()).history->noise_floor.empty()) << "a run without a reference";
}

TEST(PinnedRuns, WhatIsNoHistoryIsRefusedByName) {
  test::TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) { return refusal_of([&] { read_pin(path); }); };
  EXPECT_THAT(refusal(folder.path()), HasSubstr("history.csv"));
  EXPECT_THAT(refusal(folder.path() / "none"), HasSubstr("none: there is no such run; expected the folder of a run"));
  EXPECT_THAT(refusal(folder.write("a.txt", "no run")),
              HasSubstr("a.txt: is no run's history; expected the folder of a run"));
  EXPECT_THAT(refusal(folder.write("other.json", "{}")), HasSubstr("other.json: is no run's history"));
  EXPECT_THAT(refusal(folder.write("times.csv", "frame,draw_ms\n1,2\n")), HasSubstr("times.csv"));
  EXPECT_THAT(refusal(folder.write("empty.csv", "")), HasSubstr("empty.csv"));
  EXPECT_THAT(refusal(folder.path() / "none.csv"), HasSubstr("none.csv"));
}

} // namespace nephroid::ui::error_panel_test
