// SPDX-License-Identifier: Apache-2.0
// Runs that are measured while they work: against a file, against a recipe that is rendered once, without either; until
// an error. What cannot be measured is one clear line before anything is rendered.
#include "image/image.h"
#include "measure/run_files.h"
#include "tests/support/plate_runs.h"

namespace nephroid::reference_test {

using nephroid::read_file;
using nephroid::write_file_whole;
using nlohmann::json;

constexpr int width = 48, height = 40;

class Measured : public PlateRuns {
protected:
  /// References go to a cache of this test's own.
  Ended run(const std::string& name, const std::vector<std::string>& more) const {
    return PlateRuns::run(name, more, test::own_cache(file("cache")));
  }
  nephroid::job::History history(const std::string& name) const {
    return nephroid::measure::read_history(file(name) / "history.csv");
  }

  /// A picture file of one value, with pixel 3 changed to `third`.
  std::string picture(const std::string& name, int w, int h, float value, float third) const {
    nephroid::image::Image image;
    image.width = w;
    image.height = h;
    image.channels = {"R", "G", "B"};
    image.data.assign(static_cast<std::size_t>(3 * w * h), value);
    for (std::size_t c = 9; c < 12; ++c) image.data[c] = third;
    nephroid::image::write_exr(file(name), image);
    return file(name).string();
  }
  std::string picture(const std::string& name, int w = width, int h = height) const {
    return picture(name, w, h, 0.5f, 0.25f);
  }
};

const std::string recipe = R"(reference={"type":"recipe","passes":6})";

TEST_F(Measured, WithoutAReferenceARunLogsItsEstimate) {
  ASSERT_EQ(run("a", {"--passes", "8"}).exit_code, 0);
  const auto logged = history("a");
  EXPECT_THAT(logged.columns, Contains("estimated_lab_mean"));
  EXPECT_THAT(logged.columns, Not(Contains("lab_mean")));
  ASSERT_FALSE(logged.rows.empty());
  EXPECT_EQ(logged.rows.back().step, 8);
  EXPECT_EQ(logged.rows.back().work, 160000u);
  EXPECT_GE(logged.rows.back().wall_seconds, logged.rows.back().seconds);
  const json result = run_json("a");
  EXPECT_EQ(result["error_column"], "estimated_lab_mean");
  EXPECT_GT(result["errors"]["estimated_lab_mean"].get<double>(), 0);
  EXPECT_GT(result["measuring_seconds"].get<double>(), 0);
  EXPECT_FALSE(result.contains("reference"));
}

// With independent photons: of a low-discrepancy sequence each half has its own, so that one film gets other photons
// than two halves. Without what goes by the halves: smoothing, the deal of photons, and light on receivers, which paths
// of a half find as that half's photons have left it.
TEST_F(Measured, WithTheEstimateLeftOutThePictureIsTheSameBits) {
  std::vector<std::string> arguments{"--passes", "3"};
  for (const char* set : {"spectral.low_discrepancy=false", "spectral.smoothing=off", "spectral.effort=power",
                          "spectral.estimator=splat"})
    arguments.insert(arguments.end(), {"--set", set});
  ASSERT_EQ(run("with", arguments).exit_code, 0);
  arguments.insert(arguments.end(), {"--set", "measure.estimate=false"});
  ASSERT_EQ(run("without", arguments).exit_code, 0);
  const auto a = nephroid::image::read_image(file("with") / "image.exr"),
             b = nephroid::image::read_image(file("without") / "image.exr");
  EXPECT_EQ(a.data, b.data);
  EXPECT_FALSE(fs::exists(file("without") / "history.csv"));
}

TEST_F(Measured, ARecipeIsRenderedOnceAndItsNoiseFloorIsBesideTheErrors) {
  const Ended first = run("a", {"--passes", "4", "--set", recipe});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr("rendering the reference, 2 x 6 passes"));
  const Ended second = run("b", {"--passes", "4", "--seed", "2", "--set", recipe});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_THAT(second.err, Not(HasSubstr("rendering"))) << "it does not depend on the run's seed";
  for (const char* name : {"a", "b"}) {
    const json result = run_json(name);
    EXPECT_EQ(result["error_column"], "lab_mean");
    const double error = result["errors"]["lab_mean"], floor = result["reference"]["noise_floor"]["lab_mean"];
    EXPECT_GT(floor, 0);
    EXPECT_GT(error, floor) << "4 passes are noisier than 12";
    EXPECT_TRUE(fs::exists(result["reference"]["origin"].get<std::string>()));
  }
  EXPECT_EQ(run_json("a")["reference"], run_json("b")["reference"]);
  EXPECT_THAT(history("a").columns, Contains("lab_mean"));
  EXPECT_THAT(run("c", {"--passes", "1", "--set", recipe, "--set", "scene.lights.0.irradiance_w_m2=2"}).err,
              HasSubstr("rendering the reference"))
      << "another scene has another reference";
}

// Whatever the run saves on its own wavelengths, the reference has all of them; what the recipe itself says is another
// reference.
TEST_F(Measured, ARecipeIsOfFullQualityUnlessItSaysOtherwise) {
  const auto made_with = [&](const std::string& name, const std::vector<std::string>& settings) {
    std::vector<std::string> more{"--passes", "1"};
    for (const std::string& setting : settings) more.insert(more.end(), {"--set", setting});
    const Ended ended = run(name, more);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const fs::path origin = run_json(name)["reference"]["origin"].get<std::string>();
    const auto attributes = nephroid::image::read_image(origin).attributes;
    return std::pair(origin, json::parse(attributes.at("nephroid:preset"))["spectral"]);
  };
  const std::string one = R"(reference={"type":"recipe","passes":1})", brute = "spectral.method=brute_force";
  const auto [fine_file, fine] = made_with("fine", {one});
  const auto [coarse_file, coarse] =
      made_with("coarse", {one, brute, "spectral.step_nm=40", "spectral.max_surfaces=2"});
  EXPECT_EQ(coarse_file, fine_file) << "the same reference";
  EXPECT_EQ(fine["method"], "brute_force");
  EXPECT_EQ(fine["step_nm"], 1);
  EXPECT_EQ(fine["max_surfaces"], 256);
  const auto [own_file, own] =
      made_with("own", {R"(reference={"type":"recipe","passes":1,"spectral":{"method":"brute_force","step_nm":8}})",
                        brute, "spectral.step_nm=40"});
  EXPECT_NE(own_file, fine_file) << "one of another recipe is not taken for it";
  EXPECT_EQ(own["step_nm"], 8);
  const auto [long_file, longer] = made_with("long", {one, "spectral.max_surfaces=300"});
  EXPECT_EQ(longer["max_surfaces"], 300) << "no shorter paths than the run's";
}

TEST_F(Measured, UntilAnError) {
  const Ended ended = run("a", {"--until-error", "0.05", "--set", "stop.metric=rel_l2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto logged = history("a");
  EXPECT_LE(nephroid::job::error_in(logged, logged.rows.back(), "estimated_rel_l2"), 0.05);
  EXPECT_GT(nephroid::job::error_in(logged, logged.rows.front(), "estimated_rel_l2"), 0.05);
  EXPECT_EQ(run_json("a")["finished"], true);
}

TEST_F(Measured, AResumedRunGoesOnWithItsHistory) {
  ASSERT_EQ(run("a", {"--passes", "4"}).exit_code, 0);
  const auto before = history("a");
  ASSERT_EQ(run("a", {"--passes", "12", "--resume"}).exit_code, 0);
  const auto after = history("a");
  ASSERT_GT(after.rows.size(), before.rows.size());
  for (std::size_t i = 0; i < before.rows.size(); ++i) EXPECT_EQ(after.rows[i].seconds, before.rows[i].seconds);
  EXPECT_EQ(after.rows.back().step, 12);
}

TEST_F(Measured, WhatCannotBeAReferenceIsSaidBeforeTheRun) {
  const auto refused = [&](const std::string& line, std::vector<std::string> settings) {
    std::vector<std::string> more{"--set", "stop.passes=1"};
    for (const std::string& setting : settings) more.insert(more.end(), {"--set", setting});
    const Ended ended = run("refused", more);
    EXPECT_NE(ended.exit_code, 0) << line;
    EXPECT_THAT(ended.err, HasSubstr(line));
    EXPECT_FALSE(fs::exists(file("refused"))) << "no folder is left: " << line;
    return ended.exit_code;
  };
  const std::string good = picture("good.exr");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refused("--set reference=/nowhere/r.exr: there is no file '/nowhere/r.exr'", {"reference=/nowhere/r.exr"}),
            2);
  EXPECT_EQ(refused("the reference has 47 x 40 pixels; expected 48 x 40, as scene.camera.resolution",
                    {"reference=" + picture("small.exr", width - 1, height)}),
            2);
  EXPECT_EQ(refused("nan.exr", {"reference=" + picture("nan.exr", width, height, 0.5f, nan)}), 2);
  EXPECT_EQ(refused("good.exr: there is no reference to compare the mask's pixels with", {"measure.mask=" + good}), 2);
  EXPECT_EQ(refused("mask.exr", {"reference=" + good, "measure.mask=" + picture("mask.exr", width, height + 1)}), 2);
  EXPECT_EQ(refused("black.exr", {"reference=" + good, "measure.mask=" + picture("black.exr", width, height, 0, 0)}),
            2);
  EXPECT_EQ(refused("1 and 2 are the reference's seeds, and 1 is the run's; expected other seeds than the run's",
                    {R"(reference={"type":"recipe","seed":1})"}),
            2);
  EXPECT_THAT(run("refused", {"--seed", "1000000007", "--set", recipe}).err,
              HasSubstr("--seed: 1000000007 and 1000000008 are the reference's seeds, and 1000000007 is the run's"));
  EXPECT_EQ(refused("stop.error=1: nothing measures the error of this run: 'measure.estimate' is false",
                    {"stop.error=1", "measure.estimate=false"}),
            2);
  EXPECT_EQ(refused("\"seconds\":10}: making the reference would take about",
                    {R"(reference={"type":"recipe","passes":1000000,"seconds":10})"}),
            1);
}

TEST_F(Measured, ARunIsNoReferenceForARunWithItsSeed) {
  ASSERT_EQ(run("a", {"--passes", "2"}).exit_code, 0);
  const std::string reference = "reference=" + (file("a") / "image.exr").string();
  EXPECT_THAT(
      run("b", {"--passes", "1", "--set", reference}).err,
      HasSubstr(
          "the reference was rendered with seed 1, as this run is; expected another seed; run with another --seed"));
  EXPECT_EQ(run("b", {"--passes", "1", "--seed", "2", "--set", reference}).exit_code, 0);
}

TEST_F(Measured, ACacheThatCannotBeWrittenToIsSaidBeforeTheWork) {
  write_file_whole(file("cache"), "a file where the cache's folder should be");
  const Ended ended = run("a", {"--passes", "1", "--set", recipe});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("the reference cannot be kept here"));
  EXPECT_FALSE(fs::exists(file("a")));
}

} // namespace nephroid::reference_test
