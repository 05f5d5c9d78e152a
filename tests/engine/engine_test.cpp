// SPDX-License-Identifier: Apache-2.0
// What an engine gets by being registered: the program of this folder has the engine of gradient.cpp, which nothing
// else knows of.
#include "image/image.h"
#include "tests/support/program_test.h"
#include "tests/support/x_display.h"

namespace nephroid::engine_test {

using nlohmann::json;

class GradientEngine : public ProgramTest {
protected:
  GradientEngine() {
    write(
        "g.json",
        R"({"engine": "gradient", "name": "g", "gradient": {"noise": 0.2}, "scene": {"camera": {"resolution": [32, 16]}}})");
  }

  Ended run_to(const std::string& name, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", "g.json", "-o", name});
    return run(more);
  }
};

TEST_F(GradientEngine, RunsAndWritesWhateverItFound) {
  const Ended ended = run_to("out", {"--passes", "20"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("20 sweeps, 0.2 million samples"));
  const nephroid::image::Image picture = nephroid::image::read_image(folder / "out/image.exr");
  ASSERT_EQ(picture.width, 32);
  // The mean over 16 rows of 20 * 16 samples: noise / sqrt(5120) = 0.0028.
  double right = 0;
  const std::size_t channels = picture.channels.size();
  for (std::size_t row = 0; row < 16; ++row) right += picture.data[(row * 32 + 31) * channels] / 16;
  EXPECT_NEAR(right, 31.5 / 32, 5 * 0.0028);
  const json all = of("out/run.json");
  EXPECT_EQ(all.at("engine"), "gradient");
  EXPECT_EQ(all.at("sweeps"), 20);
  EXPECT_EQ(all.at("samples"), 20 * 16 * 32 * 16);
  EXPECT_EQ(all.at("gradient").at("level"), 1);
  EXPECT_EQ(bytes("out/gradient.txt"), "32 16\n");
  EXPECT_THAT(bytes("out/settling.csv"), HasSubstr("sweep,standard_deviation\n1,0.2\n"));
  EXPECT_THAT(bytes("out/report.html"), HasSubstr("standard_deviation"));
  EXPECT_TRUE(fs::exists(folder / "out/upside_down.exr") && fs::exists(folder / "out/upside_down.png"));
}

// The noise of a pixel after p sweeps is noise / sqrt(16 p), the same in three channels: its mean square is that of
// 0.2^2 / 16 / 64.
TEST_F(GradientEngine, MeasuresItsErrorAgainstARecipeAndByItself) {
  const Ended ended = run_to("out", {"--set", R"(reference={"type": "recipe", "passes": 1})"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json errors = of("out/run.json").at("errors");
  const double truth = 0.2 * 0.2 / 16 / 64;
  EXPECT_NEAR(errors.at("mse").get<double>() / truth, 1, 5 * std::sqrt(2.0 / 512));
  EXPECT_NEAR(errors.at("estimated_mse").get<double>() / truth, 1, 5 * std::sqrt(2.0 / 512));
}

TEST_F(GradientEngine, ResumesToTheSameBits) {
  ASSERT_EQ(run_to("whole", {"--passes", "9"}).exit_code, 0);
  ASSERT_EQ(run_to("parts", {"--passes", "4"}).exit_code, 0);
  const Ended resumed = run_to("parts", {"--passes", "9", "--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("going on in"));
  EXPECT_EQ(nephroid::image::read_image(folder / "whole/image.exr").data,
            nephroid::image::read_image(folder / "parts/image.exr").data);
}

// One job renders all frames, as it begins anew with each: the bits are those of runs of their own.
TEST_F(GradientEngine, KeepsItsJobFromFrameToFrame) {
  const Ended film = run_to("film", {"--passes", "3", "--set",
                                     R"(animation={"frames": 3, "tracks": [{"path": "gradient.level",
                                       "keys": [{"frame": 0, "value": 0.25}, {"frame": 2, "value": 0.75}]}]})"});
  ASSERT_EQ(film.exit_code, 0) << film.err;
  for (int frame = 0; frame < 3; ++frame) {
    const std::string own = fmt::format("film/frames/000{}", frame);
    EXPECT_EQ(of(own + "/run.json").at("gradient").at("adopted"), frame);
    EXPECT_EQ(of(own + "/run.json").at("sweeps"), 3);
    ASSERT_EQ(run({"run", own + "/preset.json", "-o", "alone"}).exit_code, 0);
    EXPECT_TRUE(bytes("alone/image.exr") == bytes(fmt::format("film/frame_000{}.exr", frame))) << frame;
  }
}

TEST_F(GradientEngine, IsPlannedAndInTheSchema) {
  const Ended planned = run({"plan", "g.json", "--json", "--set", "gradient.noise=0"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_EQ(json::parse(planned.out).at("passes").at(1).at("reason"), "gradient.noise is 0");
  const json schema = json::parse(run({"schema"}).out);
  EXPECT_EQ(schema.at("$defs").at("Gradient").at("properties").at("noise").at("maximum"), 1);
  EXPECT_TRUE(schema.at("properties").contains("gradient") && schema.at("properties").contains("spectral"));
}

#ifdef NEPHROID_UI
TEST_F(GradientEngine, OpensInTheWindow) {
  if (!there_is("Xvfb")) GTEST_SKIP() << "needs Xvfb";
  const XDisplay display;
  const Ended ended = run({"g.json", "--set", "gradient.noise=0", "--frames", "30", "--until", "1", "--size",
                           "1400x900", "--screenshot", "window.png"},
                          display.environment());
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const nephroid::image::Image window = nephroid::image::read_image(folder / "window.png");
  ASSERT_EQ(window.width, 1400);
  // Somewhere the picture lies: a row that grows brighter by steps, 32 greys side by side.
  int longest = 0;
  const std::size_t channels = window.channels.size();
  for (int y = 0; y < window.height; ++y) {
    int steps = 0;
    float last = 2;
    for (int x = 0; x < window.width; ++x) {
      const float* pixel = &window.data[static_cast<std::size_t>(y * window.width + x) * channels];
      const bool grey = pixel[0] == pixel[1] && pixel[1] == pixel[2];
      if (!grey || pixel[0] < last)
        longest = std::max(longest, steps), steps = 0;
      else if (pixel[0] > last)
        ++steps;
      last = grey ? pixel[0] : 2;
    }
  }
  // The picture's edge may be a shade of its own, where it does not lie on whole pixels.
  EXPECT_TRUE(longest == 31 || longest == 32) << longest;
}
#endif

TEST_F(GradientEngine, RefusesWhatIsNotItsOwn) {
  const auto refuses = [&](const std::vector<std::string>& set, const std::string& says) {
    std::vector<std::string> arguments{"plan", "g.json"};
    for (const std::string& s : set) arguments.insert(arguments.end(), {"--set", s});
    expect_refused(run(arguments), {arguments, says});
  };
  refuses(
      {"spectral.method=thesis"},
      "'spectral' has no meaning for the engine 'gradient'; it belongs to 'spectral'; remove it or change the engine");
  refuses({"engine=spectral", "gradient.noise=0"},
          "'gradient' has no meaning for the engine 'spectral'; it belongs to 'gradient'");
  refuses({"engine=graident"}, "did you mean 'gradient'?");
  refuses({"gradient.noise=2"}, "expected a number from 0 to 1");
  refuses({"gradient.noize=1"}, "did you mean 'noise'?");
  refuses({"gradient.level=0", "gradient.noise=0"}, "is black");
  refuses({R"(reference={"type": "recipe", "spectral": {}})"}, "'spectral' has no meaning for the engine 'gradient'");
}

TEST_F(GradientEngine, ACheckpointOfAnotherEngineIsRefused) {
  ASSERT_EQ(run_to("out", {"--passes", "2"}).exit_code, 0);
  write("s.json", R"({"engine": "spectral", "name": "g", "scene": {"camera": {"resolution": [32, 16]}}})");
  const Ended ended = run({"run", "s.json", "-o", "out", "--passes", "4", "--resume"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(
      ended.err,
      HasSubstr(
          "out/checkpoint.bin: is of the engine 'gradient', and the preset's is 'spectral'; run without --resume"));
}

} // namespace nephroid::engine_test
