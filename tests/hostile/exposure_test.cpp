// SPDX-License-Identifier: Apache-2.0
// "white": "auto" through the program: the number that it becomes, who shares it, and that a run of that number has the
// same bits.
#include "tests/support/plate_runs.h"
#include "tests/support/program_test.h"

namespace nephroid::exposure_test {

using nephroid::read_file;
using nlohmann::json;

class Exposure : public PlateRuns {
protected:
  Ended fitted(const std::string& name, std::vector<std::string> more, const Environment& environment = {}) const {
    more.insert(more.end(), {"--set", "white=auto"});
    return run(name, more, environment);
  }
  std::string picture(const std::string& name) const { return read_file(file(name) / "image.exr"); }
  double white(const std::string& name) const { return run_json(name)["white"]; }
};

TEST_F(Exposure, IsANumberOfTheSameBitsHoweverTheRunCameThere) {
  const Ended one = fitted("one", {"--passes", "4"}, {{"POCL_MAX_PTHREAD_COUNT", "1"}});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr(fmt::format("note: plate: white {} fits the first picture", white("one"))));
  EXPECT_GT(white("one"), 0.5);
  EXPECT_LT(white("one"), 2) << "the preset itself has 1";
  EXPECT_EQ(json::parse(read_file(file("one") / "preset.json"))["white"], white("one"));

  ASSERT_EQ(fitted("two", {"--passes", "4"}, {{"POCL_MAX_PTHREAD_COUNT", "2"}}).exit_code, 0);
  ASSERT_EQ(fitted("parts", {"--passes", "2"}).exit_code, 0);
  const Ended rest = fitted("parts", {"--passes", "4", "--resume"});
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, testing::Not(HasSubstr("fits"))) << "it goes on with its own";
  ASSERT_EQ(run("number", {"--passes", "4", "--set", fmt::format("white={}", white("one"))}).exit_code, 0);
  for (const char* name : {"two", "parts", "number"}) {
    EXPECT_EQ(white(name), white("one")) << name;
    EXPECT_TRUE(picture(name) == picture("one")) << name;
  }
  const Ended again = fitted("one", {"--passes", "4", "--resume"});
  EXPECT_THAT(again.err, HasSubstr("this run is finished"));
}

TEST_F(Exposure, IsOneForASweepAnAnimationAndAReference) {
  write_file_whole(scratch.path() / "sweep.json", R"({"parent": "spectral/plate.json", "white": "auto",
    "scene": {"camera": {"resolution": [16, 16]}}, "sweep": {"scene.lights.0.irradiance_w_m2": [1, 100]}})");
  const Ended sweep = nephroid::test::nephroid({"run", "sweep.json", "--passes", "1"}, scratch.path(), logs);
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  EXPECT_EQ(white("out/sweep/irradiance_w_m2=1"), white("out/sweep/irradiance_w_m2=100"));

  const std::string tracks =
      R"([{"path": "scene.lights.0.irradiance_w_m2", "keys": [{"frame": 0, "value": 1}, {"frame": 1, "value": 100}]}])";
  const Ended film = fitted(
      "film", {"--passes", "1", "--frames", "1", "--set", R"(animation={"frames": 2, "tracks": )" + tracks + "}"});
  ASSERT_EQ(film.exit_code, 0) << film.err;
  ASSERT_EQ(fitted("frame", {"--passes", "1", "--set", "scene.lights.0.irradiance_w_m2=1"}).exit_code, 0);
  EXPECT_EQ(white("film/frames/0001"), white("frame")) << "frame 0's, though that is not rendered";
  EXPECT_EQ(json::parse(read_file(file("film") / "preset.json"))["white"], white("frame"));

  const std::vector<std::string> measured{"--passes", "2", "--set", R"(reference={"type": "recipe", "passes": 2})"};
  const Environment cache = own_cache(scratch.path() / "cache");
  ASSERT_EQ(fitted("measured", measured, cache).exit_code, 0);
  std::vector<std::string> by_number = measured;
  by_number.insert(by_number.end(), {"--set", fmt::format("white={}", white("measured"))});
  ASSERT_EQ(run("by number", by_number, cache).exit_code, 0);
  EXPECT_EQ(run_json("measured")["errors"], run_json("by number")["errors"]);
}

TEST_F(Exposure, BadOnesAreRefusedInOneLine) {
  const auto refused = [&](const std::string& preset, const std::string& white, const std::string& says) {
    const Wrong wrong{{"run", preset, "-o", "out", "--set", "white=" + white}, says};
    expect_refused(nephroid::test::nephroid(wrong.arguments, scratch.path(), logs), wrong);
  };
  refused("spectral/plate", "automatic", R"(expected a number from 1e-12 to 1000000000000 W/(m^2 sr) or "auto")");
  refused("spectral/plate", "0", "is 0; expected a number");
}

TEST_F(Exposure, IsOneWhereWhiteChangesNothing) {
  const Ended ended =
      nephroid::test::nephroid({"run", "inverse/shapes", "-o", "out", "--passes", "1", "--set",
                                "inverse.facets=[16,16]", "--set", "inverse.cells=[8,8]", "--set", "white=auto"},
                               scratch.path(), logs);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(json::parse(read_file(scratch.path() / "out" / "preset.json"))["white"], 1);
}

} // namespace nephroid::exposure_test
