// SPDX-License-Identifier: Apache-2.0
// Engine 2 through the program: the shipped presets, small, a run whose time is over before it has a picture, and
// `nephroid segment`.
#include "tests/support/program_test.h"
#include "environment/segment/cube.h"
#include "image/image.h"
#include "tests/environment/maps.h"
#include "tests/environment/picture_files.h"

namespace nephroid::program_test {

using nlohmann::json;
using test::Ended;
using testing::ContainsRegex;

class EnvironmentRun : public ProgramTest {
protected:
  Ended run_to(const std::string& preset, const std::string& name, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", "environment/" + preset, "-o", name, "--set", "environment.resolution=16",
                               "--set", "environment.photons=1000", "--set", "environment.directions=26", "--set",
                               "scene.camera.resolution=[64, 36]"});
    return run(more, test::own_cache(scratch.path() / "cache"));
  }
  json of(const std::string& file) const { return json::parse(nephroid::read_file(folder / file)); }
};

TEST_F(EnvironmentRun, BakesAndRendersTheShippedPresets) {
  for (const std::string name : {"ball", "beam", "brilliant"}) {
    SCOPED_TRACE(name);
    const Ended ended = run_to(name, name, {"--passes", "2"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("2 passes"));
    const json all = of(name + "/run.json");
    EXPECT_EQ(all.at("passes"), 2);
    EXPECT_EQ(all.at("bake").at("from_file"), 0);
    EXPECT_EQ(all.at("lights").at("count"), 24);
    // Diamond holds light longer than its surfaces are counted.
    EXPECT_LT(all.at("energy").at("lost").get<double>(), name == "brilliant" ? 0.05 : 1e-3);
    const nephroid::image::Image image = nephroid::image::read_image(folder / name / "image.exr");
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(std::ranges::count(image.channels, "caustic.G"), 1);
    EXPECT_EQ(nephroid::image::read_image(folder / name / "spheres.exr").width, 64);
    EXPECT_EQ(nephroid::image::read_image(folder / name / "direction_001.exr").height, 256);
    const Ended again = run_to(name, "again", {"--passes", "2"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(of("again/run.json").at("bake").at("from_file"), 1);
    EXPECT_EQ(nephroid::image::read_image(folder / "again/image.exr").data, image.data);
    std::filesystem::remove_all(folder / "again");
  }
}

// Before and after the bake, in one go and in parts.
TEST_F(EnvironmentRun, HasOneWhiteAndTheSameBitsHoweverItGetsThere) {
  const std::vector<std::string> fitted{"--passes", "3", "--set", "white=auto"};
  const auto runs = [&](const std::string& name, const std::vector<std::string>& more) {
    const Ended ended = run_to("ball", name, more);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  };
  runs("cold", fitted);
  runs("warm", fitted);
  const double white = of("cold/run.json").at("white");
  EXPECT_GT(white, 2);
  EXPECT_LT(white, 8) << "the preset itself has 4";
  runs("number", {"--passes", "3", "--set", fmt::format("white={}", white)});
  runs("parts", {"--passes", "1", "--set", "white=auto"});
  EXPECT_EQ(of("parts/run.json").at("passes"), 1);
  std::vector<std::string> rest = fitted;
  rest.emplace_back("--resume");
  runs("parts", rest);
  EXPECT_EQ(of("parts/run.json").at("passes"), 3);
  for (const std::string name : {"warm", "number", "parts"}) {
    EXPECT_EQ(of(name + "/run.json").at("white"), white) << name;
    EXPECT_TRUE(bytes(name + "/image.exr") == bytes("warm/image.exr")) << name;
  }
  EXPECT_EQ(nephroid::image::read_image(folder / "cold/image.exr").data,
            nephroid::image::read_image(folder / "warm/image.exr").data);
}

TEST_F(EnvironmentRun, AFilmOfAnObjectThatMovesHasTheSameBitsResumed) {
  const auto film = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.end(),
                {"--passes", "1", "--set",
                 R"(animation={"frames":3,"tracks":[{"path":"scene.objects.0.transform.translate.0","keys":[)"
                 R"({"frame":0,"value":0},{"frame":3,"value":0.37}]}]})"});
    const Ended ended = run_to("ball", name, more);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  };
  film("whole", {});
  film("parts", {"--frames", "0"});
  film("parts", {"--resume"});
  for (int i = 0; i < 3; ++i) {
    const std::string picture = fmt::format("/frame_{:04}.exr", i);
    EXPECT_TRUE(bytes("whole" + picture) == bytes("parts" + picture)) << i;
  }
}

class EndedEarly : public test::ProgramTest {
protected:
  EndedEarly() {
    write("ball.json", R"({
  "name": "Ball", "engine": "environment", "unit": "cm", "white": 10,
  "scene": {
    "camera": {"position": [4, 4, 4], "target": [0, -1, 0], "fov_deg": 34, "resolution": [32, 24]},
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "floor": {"type": "diffuse", "reflectance": 0.8}},
    "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "glass"},
                {"name": "floor", "shape": {"type": "quad", "size": [30, 1, 30]}, "material": "floor", "transform": {"translate": [0, -1.2, 0]}}],
    "environment": {"type": "constant", "colour": [1, 1, 1], "radiance": 1}
  },
  "environment": {"directions": 26, "photons": 2000, "spheres": 2, "resolution": 16, "refine": false}
})");
  }
  Ended run_to(const std::string& name, std::vector<std::string> more) const {
    more.insert(more.begin(), {"run", "ball.json", "-o", name});
    return run(more, test::own_cache(scratch.path() / name)); // a bake of its own
  }
  bool has(const std::string& file) const { return is_there(folder / file); }
  json of(const std::string& file) const { return json::parse(read_file(folder / file)); }
};

TEST_F(EndedEarly, InTheBakeItSaysSoAndGoesOn) {
  const Ended ended = run_to("parts", {"--seconds", "0.001", "--pictures-at", "0.001"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("note: ball: no picture at 0.001 s: the first one is not there yet\n"));
  EXPECT_THAT(
      ended.err,
      ContainsRegex(
          "nephroid: parts: the run ended before its first picture, after [0-9.]+ s of work(: bake [0-9.]+ s)?; "
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

TEST_F(EndedEarly, InTheFirstPassItIsANote) {
  const Ended ended = run({"run", "spectral/plate", "-o", "plate", "--seconds", "0.001"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err, HasSubstr("note: plate: the run ended before its first pass was whole, after "));
  EXPECT_TRUE(has("plate/image.png"));
}

class SegmentVerb : public test::ProgramTest {
protected:
  void write_exr(const std::string& name, int width, int height, std::vector<std::string> channels,
                 const std::vector<float>& data) const {
    image::write_exr(folder / name, {width, height, std::move(channels), data, {}});
  }
  void write_map(const std::string& name, const scene::Environment& map) const {
    write_exr(name, map.width, map.height, {"R", "G", "B"}, map.rgb);
  }
  json segments(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "segment");
    arguments.emplace_back("--json");
    const test::Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return json::parse(ended.out);
  }
};

glm::dvec3 vector_of(const json& three) { return {three.at(0), three.at(1), three.at(2)}; }

scene::Environment sunny(double azimuth_deg) {
  return test::made_map(256, 128, [=](const glm::dvec3& d) {
    return test::sky_with_lamps(d, {0.3, 0.5, 1}, {0.2, 0.2, 0.1}, {{30, azimuth_deg, 1, {2e4, 2e4, 1e4}}});
  });
}

const json& brightest(const json& all) {
  return *std::max_element(all.at("regions").begin(), all.at("regions").end(),
                           [](const json& a, const json& b) { return a.at("flux").at(1) < b.at("flux").at(1); });
}

TEST_F(SegmentVerb, PrintsWhatTheContractSays) {
  const scene::Environment map = sunny(40);
  write_map("sunny.exr", map);
  for (const std::string method : {"variance", "thesis"})
    for (const std::string weights : {"solid-angle", "texel"}) {
      const json all = segments({"sunny.exr", "-q", "24", "--method", method, "--weights", weights});
      EXPECT_EQ(all.at("method"), method);
      EXPECT_EQ(all.at("weights"), weights);
      EXPECT_EQ(all.at("cube_size"), 128);
      EXPECT_EQ(all.at("regions").size(), 24u);
      glm::dvec3 flux{0};
      double solid_angle = 0;
      for (const json& region : all.at("regions")) {
        const glm::dvec3 direction = vector_of(region.at("direction"));
        const environment::CubePoint met = environment::met_point(direction);
        EXPECT_EQ(region.at("face"), environment::face_names.at(static_cast<std::size_t>(met.face)));
        const json& rect = region.at("rect");
        const int x = environment::texel_of(met.s, 128), y = environment::texel_of(met.t, 128);
        EXPECT_TRUE(x >= rect.at(0) && x < rect.at(2) && y >= rect.at(1) && y < rect.at(3)) << region;
        EXPECT_NEAR(glm::length(direction), 1, 1e-15);
        flux += vector_of(region.at("flux"));
        solid_angle += region.at("solid_angle_sr").get<double>();
      }
      const glm::dvec3 right = test::flux_of_texels(map), total = vector_of(all.at("total_flux"));
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(flux[c] / right[c], 1, 1e-12);
        EXPECT_NEAR(total[c] / right[c], 1, 1e-12);
      }
      EXPECT_NEAR(solid_angle, 4 * test::pi, 1e-11);
      EXPECT_GT(glm::dot(vector_of(brightest(all).at("direction")), test::direction_of(30, 40)),
                std::cos(test::pi / 180));
      EXPECT_THAT(all.at("irradiance_error").get<double>(), AllOf(testing::Gt(1e-4), testing::Lt(0.1)));
    }
  EXPECT_EQ(segments({"sunny.exr", "-q", "24"}),
            segments({"sunny.exr", "-q", "24", "--method", "variance", "--weights", "solid-angle"}));
}

TEST_F(SegmentVerb, ReadsEveryKindOfPicture) {
  const auto greys = [](int channels) { return std::vector<float>(static_cast<std::size_t>(8 * 4 * channels), 1.0f); };
  write_exr("colour.exr", 8, 4, {"R", "G", "B"}, greys(3));
  write_exr("grey.exr", 8, 4, {"Y"}, greys(1));
  write_exr("alpha.exr", 8, 4, {"R", "G", "B", "A"}, greys(4));
  write("half.exr", test::half_exr(8, 4, 0x3c00));
  write("radiance.hdr", test::radiance_hdr(8, 4));
  image::write_png_bytes(folder / "eight-bits.png", 8, 4, std::vector<unsigned char>(8 * 4 * 4, 255));
  fs::copy(folder / "half.exr", folder / "without-ending");
  for (const char* file :
       {"colour.exr", "grey.exr", "alpha.exr", "half.exr", "radiance.hdr", "eight-bits.png", "without-ending"}) {
    const json all = segments({file, "-q", "6"});
    EXPECT_EQ(all.at("regions").size(), 6u) << file;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(vector_of(all.at("total_flux"))[c], 4 * test::pi, 1e-11) << file;
  }
  write("half-as-bright.exr", test::half_exr(8, 4, 0x3800));
  EXPECT_NEAR(segments({"half-as-bright.exr", "-q", "6"}).at("total_flux").at(0), 2 * test::pi, 1e-11);
}

TEST_F(SegmentVerb, AnotherShapeIsStretchedAndSaid) {
  write_exr("square.exr", 5, 5, {"Y"}, std::vector<float>(25, 1.0f));
  const test::Ended ended = run({"segment", "square.exr", "-q", "8", "--json"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.err,
              HasSubstr("square.exr: has 5 x 5 texels; a latitude-longitude picture is twice as wide as high"));
  EXPECT_NEAR(json::parse(ended.out).at("total_flux").at(2), 4 * test::pi, 1e-11);
}

TEST_F(SegmentVerb, OneTexelAndNothingAreDefined) {
  write_exr("one.exr", 1, 1, {"Y"}, {3});
  EXPECT_EQ(segments({"one.exr", "-q", "50"}).at("regions").size(), 50u);
  write_exr("black.exr", 8, 4, {"Y"}, std::vector<float>(32, 0.0f));
  const json nothing = segments({"black.exr", "-q", "24", "-o", "black.png"});
  EXPECT_EQ(nothing.at("regions").size(), 0u);
  EXPECT_EQ(nothing.at("total_flux"), json({0.0, 0.0, 0.0}));
  EXPECT_EQ(image::read_image(folder / "black.png").width, 1024);
  EXPECT_THAT(run({"segment", "black.exr", "-q", "24"}).out, HasSubstr("black.exr: 0 lights"));
}

// The map is cut as it is in its file, and the directions turn with it: so a turning map keeps its regions.
TEST_F(SegmentVerb, APresetsMapIsTurnedAndAsBrightAsItSays) {
  write_map("sunny.exr", sunny(40));
  write(
      "p.json",
      R"({"engine": "spectral", "scene": {"environment": {"type": "file", "file": "sunny.exr", "radiance": 3, "rotate_deg": 25}}})");
  write(
      "blue.json",
      R"({"engine": "spectral", "scene": {"environment": {"type": "constant", "colour": [0, 0, 1], "radiance": 2}}})");
  const json plain = segments({"sunny.exr", "-q", "16"}), turned = segments({"p.json", "-q", "16"});
  EXPECT_EQ(turned.at("rotate_deg"), 25);
  ASSERT_EQ(turned.at("regions").size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(plain.at("regions")[i].at("rect"), turned.at("regions")[i].at("rect"));
    EXPECT_NEAR(turned.at("regions")[i].at("flux").at(1).get<double>(),
                3 * plain.at("regions")[i].at("flux").at(1).get<double>(), 1e-9);
  }
  // Counterclockwise from above is to the left of somebody who stands upright: the azimuth, which counts to the right,
  // falls.
  EXPECT_GT(glm::dot(vector_of(brightest(turned).at("direction")), test::direction_of(30, 15)),
            std::cos(test::pi / 180));
  const json blue = segments({"blue.json", "-q", "12"});
  EXPECT_EQ(blue.at("regions").size(), 12u);
  EXPECT_NEAR(blue.at("total_flux").at(2), 8 * test::pi, 1e-11);
  EXPECT_EQ(blue.at("total_flux").at(0), 0.0);
}

TEST_F(SegmentVerb, DrawsTheMapItsRegionsAndDirections) {
  write_map("sunny.exr", sunny(40));
  const test::Ended ended = run({"segment", "sunny.exr", "-q", "24", "-o", "sunny.png"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(testing::StartsWith("sunny.exr: 24 lights by the method variance"),
                               HasSubstr("irradiance is wrong by")));
  const image::Image picture = image::read_image(folder / "sunny.png");
  ASSERT_EQ(picture.width, 1024);
  ASSERT_EQ(picture.height, 512);
  const std::size_t channels = picture.channels.size();
  const auto is_green = [&](int x, int y) {
    const float* const p =
        picture.data.data() + channels * (static_cast<std::size_t>(y) * 1024 + static_cast<std::size_t>(x));
    return p[0] == 0 && p[1] == 1 && p[2] == 0;
  };
  // The sun's direction; the borders between faces at the horizon, azimuths -135, -45, 45 and 135 degrees.
  EXPECT_TRUE(is_green(512 + 40 * 1024 / 360, 256 - 30 * 512 / 180));
  for (const int column : {128, 384, 640, 896}) EXPECT_TRUE(is_green(column - 1, 250)) << column;
  int green = 0;
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 1024; ++x) green += is_green(x, y);
  EXPECT_THAT(green, AllOf(testing::Gt(4000), testing::Lt(30000)));
}

TEST_F(SegmentVerb, BadInputIsAnsweredInOneLine) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const auto with = [](float texel) {
    std::vector<float> grey(32, 1.0f);
    grey[11] = texel;
    return grey;
  };
  write_exr("sky.exr", 8, 4, {"Y"}, with(1));
  write_exr("nan.exr", 8, 4, {"Y"}, with(nan));
  write_exr("infinite.exr", 8, 4, {"Y"}, with(infinity));
  write_exr("negative.exr", 8, 4, {"Y"}, with(-1));
  write_exr("two.exr", 8, 4, {"R", "G"}, std::vector<float>(64, 1.0f));
  write("half.exr", test::half_exr(8, 4, 0x3c00).substr(0, 400));
  write("empty.exr", "");
  write("text.png", "no picture");
  write("dark.json", R"({"engine": "spectral"})");
  fs::create_directory(folder / "folder.exr");
  const std::vector<test::Wrong> cases{
      {{"segment"}, "ENVIRONMENT"},
      {{"segment", "sky.exr"}, "segment: -q is required"},
      {{"segment", "sky.exr", "-q", "5"}, "-q: '5' is not a whole number from 6 to 65536"},
      {{"segment", "sky.exr", "-q", "0"}, "-q: '0' is not"},
      {{"segment", "sky.exr", "-q", "-1"}, "-q: '-1' is not"},
      {{"segment", "sky.exr", "-q", "1e9"}, "-q: '1e9' is not"},
      {{"segment", "sky.exr", "-q", "many"}, "-q: 'many' is not"},
      {{"segment", "sky.exr", "-q", "24", "--method", "halving"}, "--method"},
      {{"segment", "sky.exr", "-q", "24", "--weights", "none"}, "--weights"},
      {{"segment", "sky.exr", "-q", "24", "--wieghts", "texel"}, "did you mean '--weights'?"},
      {{"segment", "sky.exr", "-q", "24", "-o", "sky.jpg"}, "-o: the picture is a PNG, not 'sky.jpg'"},
      {{"segment", "sky.exr", "-q", "24", "-o", "no/such/folder/sky.png"}, "no/such/folder", 1},
      {{"segment", "nan.exr", "-q", "24"}, "nan.exr: red of the texel in row 1, column 3 (from 0) is not a number"},
      {{"segment", "infinite.exr", "-q", "24"}, "column 3 (from 0) is infinite"},
      {{"segment", "negative.exr", "-q", "24"}, "column 3 (from 0) is negative"},
      {{"segment", "two.exr", "-q", "24"}, "two.exr: has the channels"},
      {{"segment", "half.exr", "-q", "24"}, "half.exr: "},
      {{"segment", "empty.exr", "-q", "24"}, "empty.exr: "},
      {{"segment", "text.png", "-q", "24"}, "text.png: is no picture that can be read"},
      {{"segment", "folder.exr", "-q", "24"}, "folder.exr: "},
      {{"segment", "none.exr", "-q", "24"},
       "none.exr: no such file; expected a picture (EXR, HDR, PNG, ...) or a preset"},
      {{"segment", "no-such-preset", "-q", "24"}, "there is no preset 'no-such-preset'"},
      {{"segment", "dark.json", "-q", "24"}, "dark.json#/scene/environment: the preset has no environment"},
  };
  for (const test::Wrong& wrong : cases) test::expect_refused(run(wrong.arguments), wrong);
}

} // namespace nephroid::program_test
