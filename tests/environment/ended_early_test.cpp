// SPDX-License-Identifier: Apache-2.0
// A run whose time is over before it has a picture: it says so and where its time went, leaves no other picture in its place, and goes on.
#include "base/files.h"
#include "image/image.h"
#include "tests/support/program_test.h"

#include <nlohmann/json.hpp>

namespace {

using namespace nephroid;
using nlohmann::json;
using test::Ended;
using testing::ContainsRegex;
using testing::HasSubstr;

class EndedEarly : public test::ProgramTest {
protected:
  EndedEarly()
  {
    write("ball.json", R"({
  "name": "Ball", "engine": "environment", "unit": "cm", "white": 10,
  "scene": {
    "camera": {"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34, "resolution": [32, 24]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "glass"},
                {"name": "floor", "shape": {"type": "quad", "size": [30, 1, 30]}, "material": "floor", "transform": {"translate": [0, -1.2, 0]}}],
    "environment": {"type": "constant", "colour": [1, 1, 1], "radiance": 1}
  },
  "environment": {"photons": 8000, "spheres": 2, "resolution": 16}
})");
  }
  Ended run_to(const std::string& name, std::vector<std::string> more) const
  {
    more.insert(more.begin(), {"run", "ball.json", "-o", name});
    return run(more, {{"XDG_CACHE_HOME", (scratch.path() / name).string()}}); // a bake of its own
  }
  bool has(const std::string& file) const { return is_there(folder / file); }
  json of(const std::string& file) const { return json::parse(read_file(folder / file)); }
};

TEST_F(EndedEarly, InTheBakeItSaysSoAndGoesOn)
{
  const Ended ended = run_to("parts", {"--seconds", "0.001", "--pictures-at", "0.001"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("note: ball: no picture at 0.001 s: the first one is not there yet\n"));
  EXPECT_THAT(ended.err,
              ContainsRegex("nephroid: parts: the run ended before its first picture, after [0-9.]+ s of work(: bake [0-9.]+ s)?; "
                            "a checkpoint is saved; go on with --resume"));
  EXPECT_THAT(ended.out, testing::StartsWith("parts: 0 passes, "));
  for (const char* file : {"image.png", "image.exr", "at-0000.001s.png", "report.html"})
    EXPECT_FALSE(has(std::string("parts/") + file)) << file;
  EXPECT_TRUE(has("parts/checkpoint.bin"));
  EXPECT_EQ(of("parts/run.json").at("finished"), false);
  EXPECT_GT(of("parts/run.json").at("phase_seconds").at("bake"), 0);

  const Ended again = run_to("parts", {"--seconds", "0.001", "--resume"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("the run ended before its first picture"));

  const Ended resumed = run_to("parts", {"--passes", "1", "--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("going on in pass 1"));
  ASSERT_EQ(run_to("whole", {"--passes", "1"}).exit_code, 0);
  EXPECT_EQ(image::read_image(folder / "parts/image.exr").data, image::read_image(folder / "whole/image.exr").data);
}

TEST_F(EndedEarly, InTheFirstPassItIsANote)
{
  const Ended ended = run({"run", "spectral/plate", "-o", "plate", "--seconds", "0.001"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr("note: plate: the run ended before its first pass was whole, after "));
  EXPECT_TRUE(has("plate/image.png"));
}

} // namespace
