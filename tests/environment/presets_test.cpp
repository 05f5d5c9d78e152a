// SPDX-License-Identifier: Apache-2.0
// The shipped presets of engine 2 through the program, small: their files, a second start, a run that is resumed.
#include "image/image.h"
#include "tests/support/program_test.h"

#include <nlohmann/json.hpp>

namespace nephroid::presets_test {

using nlohmann::json;

class EnvironmentRun : public ProgramTest {
protected:
  Ended run_to(const std::string& preset, const std::string& name, std::vector<std::string> more = {}) const
  {
    more.insert(more.begin(), {"run", "environment/" + preset, "-o", name, "--set", "environment.resolution=32", "--set",
                               "environment.photons=30000", "--set", "scene.camera.resolution=[420, 220]"});
    const char* home = std::getenv("HOME"); // compiled kernels stay where they are
    return run(more, {{"XDG_CACHE_HOME", (scratch.path() / "cache").string()},
                      {"POCL_CACHE_DIR", std::string(home ? home : "/tmp") + "/.cache/pocl/kcache"}});
  }
  json of(const std::string& file) const { return json::parse(nephroid::read_file(folder / file)); }
};

TEST_F(EnvironmentRun, BakesAndRendersTheShippedPresets)
{
  for (const std::string name : {"ball", "beam", "bunny", "glass", "ring", "brilliant"}) {
    SCOPED_TRACE(name);
    const Ended ended = run_to(name, name, {"--passes", "2"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("2 passes"));
    const json all = of(name + "/run.json");
    EXPECT_EQ(all.at("passes"), 2);
    EXPECT_EQ(all.at("bake").at("from_file"), 0);
    EXPECT_EQ(all.at("lights").at("count"), 24);
    // Glass and diamond hold light longer than its surfaces are counted.
    EXPECT_LT(all.at("energy").at("lost").get<double>(), name == "brilliant" ? 0.05 : name == "glass" ? 0.025 : 1e-3);
    const nephroid::image::Image image = nephroid::image::read_image(folder / name / "image.exr");
    EXPECT_EQ(image.width, 420);
    EXPECT_EQ(std::ranges::count(image.channels, "caustic.G"), 1);
    EXPECT_EQ(nephroid::image::read_image(folder / name / "spheres.exr").width, 420);
    EXPECT_EQ(nephroid::image::read_image(folder / name / "direction_001.exr").height, 256);
    const Ended again = run_to(name, "again", {"--passes", "2"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(of("again/run.json").at("bake").at("from_file"), 1);
    EXPECT_EQ(nephroid::image::read_image(folder / "again/image.exr").data, image.data);
    std::filesystem::remove_all(folder / "again");
  }
}

TEST_F(EnvironmentRun, GoesOnWhereItStopped)
{
  ASSERT_EQ(run_to("ball", "whole", {"--passes", "4"}).exit_code, 0);
  const Ended part = run_to("ball", "part", {"--passes", "1"});
  ASSERT_EQ(part.exit_code, 0) << part.err;
  EXPECT_EQ(of("part/run.json").at("passes"), 1);
  const Ended rest = run_to("ball", "part", {"--resume", "--passes", "4"});
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(of("part/run.json").at("passes"), 4);
  EXPECT_EQ(nephroid::image::read_image(folder / "part/image.exr").data, nephroid::image::read_image(folder / "whole/image.exr").data);
}

} // namespace nephroid::presets_test
