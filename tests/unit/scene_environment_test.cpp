// SPDX-License-Identifier: Apache-2.0
// Environments as the scene loads them: which pictures are taken, which are refused and with what line.
#include "image/image.h"
#include "tests/support/errors.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::scene_environment_test {

using namespace nephroid::scene;

class SceneEnvironment : public testing::Test {
protected:
  test::TemporaryFolder temporary;
  std::vector<std::string> warnings;

  std::string write_exr(const std::vector<float>& data, int width, std::vector<std::string> channels = {"R", "G", "B"}) const
  {
    const int height = static_cast<int>(data.size() / channels.size()) / width;
    const std::string file = (temporary.path() / "sky.exr").string();
    image::write_exr(file, {width, height, std::move(channels), data, {}});
    return file;
  }
  Environment load(const std::string& file)
  {
    preset::Environment environment;
    environment.file = file;
    environment.radiance = 3;
    environment.rotate_deg = 20;
    return make_environment(environment, FileFinder(), Place("p.json", "/scene/environment"), warnings);
  }
};

TEST_F(SceneEnvironment, FloatsAreTakenAsTheyAre)
{
  const Environment e = load(write_exr({1, 2, 3, 4, 5, 1e6f}, 2));
  EXPECT_EQ(e.width, 2);
  EXPECT_EQ(e.height, 1);
  EXPECT_THAT(e.rgb, ElementsAre(1, 2, 3, 4, 5, 1e6f));
  EXPECT_EQ(e.radiance, 3);
  EXPECT_EQ(e.rotate_deg, 20);
  EXPECT_FALSE(e.is_black());
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(SceneEnvironment, IntegersAreDecodedAndGreyHasThreeChannels)
{
  const std::string png = (temporary.path() / "sky.png").string();
  image::write_png_bytes(png, 2, 1, {0, 255, 188, 255, 255, 255, 255, 255});
  const Environment e = load(png);
  EXPECT_EQ(e.rgb[1], 1);
  EXPECT_NEAR(e.rgb[2], 0.50289, 1e-5); // IEC 61966-2-1 of 188 / 255
  EXPECT_THAT(load(write_exr({0.5f, 0.25f}, 2, {"Y"})).rgb, ElementsAre(0.5f, 0.5f, 0.5f, 0.25f, 0.25f, 0.25f));
}

TEST_F(SceneEnvironment, AConstantIsOneTexel)
{
  preset::Environment environment;
  environment.type = preset::Environment::Type::constant;
  environment.colour = {0.25, 0.5, 0};
  Environment e = make_environment(environment, FileFinder(), Place("p.json", "/scene/environment"), warnings);
  EXPECT_EQ(e.width * e.height, 1);
  EXPECT_THAT(e.rgb, ElementsAre(0.25f, 0.5f, 0));
  EXPECT_FALSE(e.is_black());
  e.radiance = 0;
  EXPECT_TRUE(e.is_black());
}

TEST_F(SceneEnvironment, ABadTexelIsNamed)
{
  std::vector<float> sky(3 * 8, 1.0f);
  sky[3 * 6 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }),
              HasSubstr("sky.exr: green of the texel in row 1, column 2 (from 0) is not a number"));
  sky[3 * 6 + 1] = 1;
  sky[3 * 3] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }), HasSubstr("red of the texel in row 0, column 3 (from 0) is infinite"));
  sky[3 * 3] = 1;
  sky[3 * 7 + 2] = -1;
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }), HasSubstr("blue of the texel in row 1, column 3 (from 0) is negative"));
}

// As every map of Debian's blender-data has them, which are compressed with loss.
TEST_F(SceneEnvironment, AFewValuesBelowNothingAreBlackAndSaid)
{
  std::vector<float> sky(3 * 8, 1.0f);
  sky[3 * 7 + 2] = sky[4] = -0.01f; // 0.02 of 22
  const Environment e = load(write_exr(sky, 4));
  EXPECT_EQ(e.rgb[3 * 7 + 2], 0);
  EXPECT_EQ(e.rgb[4], 0);
  EXPECT_EQ(e.rgb[0], 1);
  EXPECT_THAT(warnings, ElementsAre("environment sky.exr: 2 values are below 0, in sum 0.0009 of all its light; they are taken as 0"));
  sky[4] = -0.02f;
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }), HasSubstr("green of the texel in row 0, column 1 (from 0) is negative"));
}

TEST_F(SceneEnvironment, WhatIsNoSuchPictureIsRefused)
{
  EXPECT_THAT(refusal_of([&] { load(temporary.write("sky.hdr", "not a picture")); }),
              AllOf(HasSubstr("sky.hdr: is no picture that can be read: "), HasSubstr("; expected a whole EXR, HDR, PNG, JPEG or another"),
                    EndsWith("; save it anew, or name another file")));
  EXPECT_THAT(refusal_of([&] { load(write_exr({1, 2}, 1, {"R", "G"})); }), HasSubstr("has the channels"));
  EXPECT_THAT(refusal_of([&] { load("no-such-sky.exr"); }), HasSubstr("p.json#/scene/environment/file"));
}

TEST_F(SceneEnvironment, AnotherShapeIsStretchedAndSaid)
{
  const Environment e = load(write_exr(std::vector<float>(3 * 4 * 4, 1.0f), 4));
  EXPECT_EQ(e.height, 4);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("4 x 4 texels"));
}

// The film resolves 2^-20 of the mean. What is 0 is black whatever the film resolves.
TEST_F(SceneEnvironment, ARangeThatTheFilmCannotHoldIsSaid)
{
  std::vector<float> sky(3 * 8, 1.0f);
  sky[5] = 1e12f;
  load(write_exr(sky, 4));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("sky.exr: half of its values above 0 are below 2e-11 of its mean"));
  warnings.clear();
  std::fill(sky.begin(), sky.end(), 0.0f);
  for (const std::size_t i : {0, 1, 2, 3}) sky[i] = i < 2 ? 1e12f : 1;
  load(write_exr(sky, 4));
  EXPECT_THAT(warnings, IsEmpty()) << "half is not more than half";
  sky[4] = 1;
  load(write_exr(sky, 4));
  EXPECT_EQ(warnings.size(), 1u);
  warnings.clear();
  load(write_exr(std::vector<float>(3 * 8, 0.0f), 4));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(SceneEnvironment, TheSceneHasIt)
{
  preset::Preset preset = test::ball_over_floor();
  EXPECT_FALSE(load_scene(preset).environment);
  preset.scene.environment.emplace();
  preset.scene.environment->file = write_exr(std::vector<float>(3 * 8 * 4, 0.5f), 8);
  const Scene scene = load_scene(preset);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->width, 8);
}

} // namespace nephroid::scene_environment_test
