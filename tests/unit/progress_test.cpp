// SPDX-License-Identifier: Apache-2.0
// How a run shows where it is: its pace, the line on a terminal, JSON lines, and when each comes.
#include "cli/progress.h"
#include "tests/support/program_test.h"

namespace nephroid::progress_test {

using Json = nlohmann::json;
using namespace nephroid::cli;

job::Progress at(double fraction, std::int64_t step, std::uint64_t photons, double work_seconds) {
  return {.fraction = fraction, .step = step, .steps = 100, .work = photons, .work_seconds = work_seconds};
}

TEST(Pace, IsThatOfThisSessionOnly) {
  // Resumed at half way after 100 s of work on a slow machine; here a quarter took 5 s.
  const job::Pace pace = job::pace_between(at(0.5, 50, 1'000'000, 100), at(0.75, 75, 3'000'000, 105));
  EXPECT_DOUBLE_EQ(pace.work_per_second, 400'000);
  EXPECT_DOUBLE_EQ(pace.seconds_left, 5);
}

TEST(Pace, IsUnknownAtTheStart) {
  const job::Pace pace = job::pace_between(at(0, 0, 0, 0), at(0, 0, 0, 0));
  EXPECT_EQ(pace.work_per_second, 0);
  EXPECT_LT(pace.seconds_left, 0);
}

TEST(ProgressLine, HasBarPassRateAndTimeLeft) {
  const std::string line = progress_line("prism", at(0.5, 50, 0, 0), {1.214e6, 3661}, 100);
  EXPECT_EQ(line, "prism  [###############---------------]   50 %  pass 51 of 100  1.21 M photons/s  1:01:01 left");
  EXPECT_THAT(progress_line("prism", at(0.999, 99, 0, 0), {950, 7.4}, 100),
              HasSubstr(" 99 %  pass 100 of 100  950 photons/s  0:07 left"));
  EXPECT_THAT(progress_line("prism", at(0, 0, 0, 0), {}, 100), Not(HasSubstr("left")))
      << "no figure before there is one";
}

TEST(ProgressLine, CountsThePassInHand) {
  EXPECT_THAT(progress_line("prism", at(0.004, 0, 0, 0), {}, 100), HasSubstr("  0 %  pass 1 of 100"));
  EXPECT_THAT(progress_line("prism", at(1, 100, 0, 0), {}, 100), HasSubstr("100 %  pass 100 of 100"));
  job::Progress by_time = at(0.5, 7, 0, 0);
  by_time.steps = -1;
  EXPECT_THAT(progress_line("prism", by_time, {}, 100), EndsWith(" 50 %  pass 8"));
}

TEST(ProgressLine, NeverIsWiderThanTheTerminal) {
  for (int columns = 0; columns < 200; ++columns)
    EXPECT_LE(progress_line("a-rather-long-name-of-a-preset", at(1, 1'000'000, 0, 0), {1e12, 1e12}, columns).size(),
              static_cast<std::size_t>(std::max(columns, 1)));
}

TEST(ProgressJson, IsOneLineOfValidJsonWithNullsForTheUnknown) {
  const std::string line = progress_json({"label", "odd \"name\"\n\xff"}, at(0.25, 3, 12, 0.5), {});
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  const auto json = Json::parse(line);
  EXPECT_EQ(json["type"], "progress");
  EXPECT_EQ(json["name"], "odd \"name\"\n\xef\xbf\xbd");
  EXPECT_EQ(json["stage"], "run");
  EXPECT_EQ(Json::parse(progress_json({"", "", "reference"}, at(0, 0, 0, 0), {}))["stage"], "reference");
  EXPECT_EQ(json["fraction"], 0.25);
  EXPECT_EQ(json["step"], 3);
  EXPECT_EQ(json["photons"], 12);
  EXPECT_TRUE(json["seconds_left"].is_null());
  job::Progress endless = at(0, 1, 0, 0);
  endless.steps = -1;
  EXPECT_TRUE(Json::parse(progress_json({}, endless, {}))["steps"].is_null());
}

TEST(ProgressStyle, IsJsonWhereAskedAndLinesWithoutATerminal) {
  EXPECT_EQ(progress_style(true), ProgressStyle::json);
  const test::Variable terminal("TERM", "dumb");
  EXPECT_EQ(progress_style(false), ProgressStyle::lines);
}

constexpr ProgressDisplay::Clock::time_point begin{};

TEST(ProgressDisplay, JsonComesEachHalfSecondAndAtTheEnd) {
  testing::internal::CaptureStdout();
  {
    ProgressDisplay display(ProgressStyle::json, {}, at(0, 0, 0, 0), begin);
    display.update(at(0.1, 1, 10, 1), begin + std::chrono::milliseconds(499));
    display.update(at(0.2, 2, 20, 2), begin + std::chrono::milliseconds(500));
    display.update(at(0.3, 3, 30, 3), begin + std::chrono::milliseconds(999));
    display.finish(at(1, 4, 40, 4));
  }
  const std::vector<Json> shown = json_lines(testing::internal::GetCapturedStdout());
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0]["fraction"], 0.2);
  EXPECT_EQ(shown[1]["fraction"], 1.0);
}

TEST(ProgressDisplay, TheLiveLineIsTakenAway) {
  testing::internal::CaptureStderr();
  {
    ProgressDisplay display(ProgressStyle::live, {"a", ""}, at(0, 0, 0, 0), begin);
    display.update(at(0.5, 1, 10, 1), begin + std::chrono::milliseconds(100));
  }
  const std::string shown = testing::internal::GetCapturedStderr();
  EXPECT_THAT(shown, HasSubstr("\ra  [##"));
  EXPECT_THAT(shown, EndsWith("\r\033[K"));
}

} // namespace nephroid::progress_test
