// SPDX-License-Identifier: Apache-2.0
// The panel "Error": what it plots of any history, how its axes follow, how long a frame takes, what it copies.
#include "measure/history_file.h"
#include "window_fixture.h"

namespace nephroid::ui::error_panel_test {

class ErrorPanelTest : public test::WindowFixture {
protected:
  void hover(const std::array<double, 4>& area)
  {
    imgui.move(area[0] + area[2] / 2, area[1] + area[3] / 2);
    frame();
  }
};

TEST_F(ErrorPanelTest, ThePlotFollowsTheRunInHand)
{
  frames(3);
  EXPECT_TRUE(workspace.panel<ui::ErrorPanel>().contents().runs.empty()) << "nothing is open";
  measured();
  open();
  finish();
  const PlotContents& contents = workspace.panel<ui::ErrorPanel>().contents();
  EXPECT_EQ(contents.metric, "lab_mean");
  ASSERT_THAT(contents.runs, SizeIs(1));
  EXPECT_EQ(contents.runs[0].lines->error.curve.seconds.size(), 20u);
  const PlotRange& shown = workspace.panel<ui::ErrorPanel>().plot().shown();
  EXPECT_LT(shown.seconds[0], 0.01);
  EXPECT_GT(shown.seconds[1], 0.2);
  workbench.apply({command::ChooseMetric{"rel_mse"}});
  frame();
  EXPECT_EQ(workspace.panel<ui::ErrorPanel>().contents().metric, "rel_mse");
  workbench.apply({command::ChooseMetric{"flip"}});
  frame();
  EXPECT_EQ(workspace.panel<ui::ErrorPanel>().contents().metric, "lab_mean") << "no run has that one";
}

TEST_F(ErrorPanelTest, HistoriesOfAnyKindAreDrawn)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto nothing = std::make_shared<job::History>();
  auto no_rows = falling_history(0);
  auto one_row = falling_history(1);
  auto all_nan = falling_history(5);
  for (job::HistoryRow& row : all_nan->rows) row.errors = {nan, nan, nan};
  auto same = falling_history(5); // all at one time and of one error
  for (job::HistoryRow& row : same->rows) {
    row.seconds = 1;
    row.errors = {1, 1, 1};
  }
  auto zero = falling_history(5);
  for (job::HistoryRow& row : zero->rows) row.errors = {0, 0, 0};
  auto psnr = falling_history(5);
  psnr->columns = {"psnr_db", "iw_ssim", "estimated_lab_mean"};
  psnr->error_column = "psnr_db";
  auto floor = falling_history(50);
  floor->noise_floor = {0.02, nan, nan};
  floor->target = 0.03;
  runs.steps = 2;
  for (const auto& history : {nothing, no_rows, one_row, all_nan, same, zero, psnr, floor}) {
    runs.history = [&](int) { return history; };
    open();
    finish();
    workbench.apply({command::PinRun{}});
    frames(2);
    hover(workspace.panel<ui::ErrorPanel>().plot().area());
    EXPECT_TRUE(workbench.messages().empty());
    EXPECT_EQ(workbench.run().error_history(), history);
  }
  EXPECT_EQ(workspace.panel<ui::ErrorPanel>().contents().target, 0.03);
  workbench.apply({command::ChooseMetric{"psnr_db"}});
  frames(2);
  EXPECT_EQ(workspace.panel<ui::ErrorPanel>().contents().metric, "psnr_db");
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(ErrorPanelTest, TenThousandRowsAreDrawnWithFewPoints)
{
  const auto history = falling_history(10000);
  runs.steps = 2;
  runs.history = [&](int) { return history; };
  open();
  finish();
  for (int i = 0; i < 5; ++i) workbench.apply({command::PinRun{}});
  frames(2);
  // What a frame costs goes by what it draws: 60000 rows unthinned would be 480000 corners and more, not 29000.
  ASSERT_NE(ImGui::GetDrawData(), nullptr);
  EXPECT_LT(ImGui::GetDrawData()->TotalVtxCount, 60000);
}

TEST_F(ErrorPanelTest, TheWheelLetsTheAxesGoAndADoubleClickTakesThemBack)
{
  measured();
  open();
  finish();
  const PlotRange before = workspace.panel<ui::ErrorPanel>().plot().shown();
  hover(workspace.panel<ui::ErrorPanel>().plot().area());
  for (int i = 0; i < 3; ++i) {
    imgui.wheel(1);
    frame();
  }
  frames(2);
  EXPECT_FALSE(workspace.panel<ui::ErrorPanel>().plot().follows());
  EXPECT_GT(workspace.panel<ui::ErrorPanel>().plot().shown().seconds[0], before.seconds[0]);
  EXPECT_EQ(camera().position[2], 4) << "the wheel over the plot is the plot's";
  for (int click = 0; click < 2; ++click) {
    imgui.button(0, true);
    frame();
    imgui.button(0, false);
    frame();
  }
  frames(2);
  EXPECT_TRUE(workspace.panel<ui::ErrorPanel>().plot().follows());
  EXPECT_NEAR(workspace.panel<ui::ErrorPanel>().plot().shown().seconds[0], before.seconds[0], 1e-9);
}

} // namespace nephroid::ui::error_panel_test
