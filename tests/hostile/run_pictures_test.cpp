// SPDX-License-Identifier: Apache-2.0
// Pictures that a run leaves on its way, at the times that were asked for, also where it goes on later.
#include "image/image.h"
#include "measure/run_files.h"
#include "tests/support/plate_runs.h"
#include "tests/support/program_test.h"

namespace nephroid::run_pictures_test {

using nlohmann::json;

class RunPictures : public PlateRuns {
protected:
  using PlateRuns::file;
  fs::path file(const std::string& name, const std::string& which) const { return file(name) / which; }
};

TEST_F(RunPictures, LeavePicturesAtTheTimesThatWereAskedFor) {
  const Ended ended = run("a", {"--seconds", "1", "--pictures-at", ".6,+2e-1,9,.2", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("no picture at 9 s"));
  const json pictures = run_json("a").at("pictures");
  ASSERT_EQ(pictures.size(), 2u);
  std::vector<json> told;
  for (const json& line : json_lines(ended.out))
    if (line["type"] == "picture") told.push_back(line);
  ASSERT_EQ(told.size(), 2u);
  const auto history = measure::read_history(file("a", "history.csv"));
  for (std::size_t i = 0; i < 2; ++i) {
    const json& made = pictures[i];
    EXPECT_EQ(made["seconds"], i == 0 ? 0.2 : 0.6);
    EXPECT_EQ(made["picture"], i == 0 ? "at-0000.2s.png" : "at-0000.6s.png");
    EXPECT_EQ(told[i]["picture"], made["picture"]);
    EXPECT_EQ(told[i]["errors"], made["errors"]);
    EXPECT_TRUE(fs::exists(scratch.path() / "a" / made["picture"]));
    const double when = made["work_seconds"];
    EXPECT_GE(when, made["seconds"]);
    EXPECT_TRUE(std::ranges::none_of(history.rows, [&](const auto& r) {
      return r.seconds > made["seconds"] && r.seconds < when - 1e-5;
    })) << "it is of the first step that ends after its time";
    const auto row = std::find_if(history.rows.begin(), history.rows.end(),
                                  [&](const auto& r) { return std::abs(r.seconds - when) < 1e-5; });
    ASSERT_NE(row, history.rows.end()) << "its error is its own";
    const double error = job::error_in(history, *row, "estimated_lab_mean");
    EXPECT_NEAR(made["errors"]["estimated_lab_mean"], error, 1e-4 * error);
  }
  const auto early = image::read_image(file("a", "at-0000.2s.exr")), last = image::read_image(file("a", "image.exr"));
  EXPECT_EQ(early.channels, last.channels);
  if (pictures[0]["work_seconds"] > 0.3) return; // the machine stood still, and a step took as long as many
  EXPECT_LT(pictures[1]["errors"]["estimated_rel_l2"], pictures[0]["errors"]["estimated_rel_l2"]);
  EXPECT_NE(early.data, last.data);

  EXPECT_THAT(messages_of(run("a", {"--passes", "1"})), IsEmpty());
  EXPECT_FALSE(fs::exists(file("a", "at-0000.2s.png"))) << "another run's";
  EXPECT_FALSE(fs::exists(file("a", "pictures.json")));
}

TEST_F(RunPictures, KeepTheirPicturesWhenTheyGoOn) {
  ASSERT_EQ(run("a", {"--seconds", ".5", "--pictures-at", ".2"}).exit_code, 0);
  const std::string before = read_file(file("a", "at-0000.2s.png"));
  // However long the last step took, the second picture is still to come.
  const double later = std::ceil(10 * run_json("a")["work_seconds"].get<double>() + 1) / 10;
  const Ended ended =
      run("a", {"--seconds", fmt::to_string(later + 0.2), "--pictures-at", fmt::format(".1,.2,{}", later), "--resume"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("0.1 s of work are past"));
  EXPECT_THAT(ended.err, testing::Not(HasSubstr("0.2 s of work are past")));
  EXPECT_TRUE(read_file(file("a", "at-0000.2s.png")) == before);
  ASSERT_EQ(run_json("a").at("pictures").size(), 2u);
  EXPECT_EQ(run_json("a")["pictures"][0]["seconds"], 0.2);
  const std::string picture = run_json("a")["pictures"][1]["picture"];
  EXPECT_THAT(ended.err, testing::ContainsRegex(picture + " after [0-9.]+ s of work, estimated_lab_mean "));

  // Killed after a picture and before the next checkpoint: the work is done again, and so is the picture.
  json list = json::parse(read_file(file("a", "pictures.json")));
  list[1]["work_seconds"] = 1000;
  write_file_whole(file("a", "pictures.json"), list.dump());
  ASSERT_EQ(run("a", {"--seconds", fmt::to_string(later + 0.3), "--resume"}).exit_code, 0);
  EXPECT_EQ(run_json("a")["pictures"].size(), 1u);
  EXPECT_FALSE(fs::exists(file("a", picture)));

  write_file_whole(file("a", "pictures.json"), "[{}, 3");
  EXPECT_EQ(run("a", {"--seconds", fmt::to_string(later + 0.4), "--resume"}).exit_code, 0) << "a damaged list is none";
}

} // namespace nephroid::run_pictures_test
