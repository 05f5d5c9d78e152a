// SPDX-License-Identifier: Apache-2.0
// What the panel "Environment" shows, without a window: what is made anew when, held against the engine's own functions; maps that are not
// there or not maps.
#include "environment/segment/quality.h"
#include "environment/settings.h"
#include "image/image.h"
#include "preset/read.h"
#include "tests/environment/maps.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"
#include "ui/environment/model.h"

namespace nephroid::ui::environment_model_test {

using environment::SegmentMethod;

class EnvironmentModelTest : public ::testing::Test {
protected:
  EnvironmentModelTest()
  {
    for (const auto& [name, map] : test::synthetic_maps(128))
      image::write_exr(folder.path() / (name + ".exr"), {map.width, map.height, {"R", "G", "B"}, map.rgb, {}});
    preset =
        preset::parse_preset(R"({"engine": "environment", "scene": {"environment": "noon.exr"}})", (folder.path() / "test.json").string());
  }
  ShownMap shown_of(const preset::Preset& wanted, const MapPictureSize& size = {MapLayout::latitude_longitude, 64})
  {
    want(wanted, size);
    EXPECT_TRUE(test::eventually([&] { want(wanted, size); }, [&] { return model.rests(); }));
    return model.shown();
  }
  /// As a frame does.
  void want(const preset::Preset& wanted, const MapPictureSize& size = {MapLayout::latitude_longitude, 64})
  {
    tasks.collect(messages);
    model.want(wanted_map(wanted, size), tasks);
  }
  ShownMap edited(const std::function<void(preset::Preset&)>& change)
  {
    change(preset);
    return shown_of(preset);
  }

  test::TemporaryFolder folder;
  Messages messages;
  TaskQueue tasks;
  EnvironmentModel model;
  preset::Preset preset;
};

TEST_F(EnvironmentModelTest, HasWhatTheEngineHas)
{
  const ShownMap shown = shown_of(preset);
  ASSERT_TRUE(shown.map && shown.cut && shown.picture && shown.cut_error);
  EXPECT_EQ(shown.error, "");
  EXPECT_EQ(shown.map->width, 128);
  const environment::CubeMap cube = environment::make_cube_map(test::synthetic_maps(128).front().map);
  const std::vector<glm::dvec3> truth = environment::irradiances(cube);
  for (const SegmentMethod method : {SegmentMethod::variance, SegmentMethod::thesis}) {
    const Quality& quality = shown.quality.at(static_cast<std::size_t>(method));
    ASSERT_THAT(quality, SizeIs(quality_lights.size()));
    for (const std::size_t i : {std::size_t{0}, std::size_t{4}, std::size_t{9}}) {
      const auto cut = environment::segment(cube, {.lights = quality_lights.at(i), .method = method});
      EXPECT_NEAR(quality[i], environment::irradiance_error(truth, cut), 1e-12) << quality_lights.at(i);
    }
    EXPECT_LT(quality.back(), 0.2 * quality.front());
  }
  EXPECT_EQ(*shown.cut_error, shown.quality[0][4]) << "24 lights by variance are the default";
  EXPECT_THAT(shown.cut->segmentation.lights, SizeIs(24));
  EXPECT_EQ(shown.picture->rgba.size(), 4u * 64 * 32);
}

TEST_F(EnvironmentModelTest, MakesAnewWhatAnEditChanges)
{
  shown_of(preset);
  EXPECT_EQ(model.maps_read(), 1);
  EXPECT_EQ(model.cuts_made(), 1);
  const auto before = model.shown();
  edited([](preset::Preset& p) {
    p.scene.environment->rotate_deg = 75;
    p.scene.environment->radiance = 3;
    p.scene.environment->lights = true;
    p.white = 2;
  });
  EXPECT_EQ(model.shown().cut, before.cut) << "it is the same cube, turned and brighter";
  EXPECT_EQ(model.shown().picture, before.picture);
  edited([](preset::Preset& p) { environment::settings(p).lights = 48; });
  EXPECT_EQ(model.cuts_made(), 2);
  EXPECT_EQ(model.shown().cut_error, before.quality[0][6]);
  EXPECT_NE(model.shown().picture->rgba, before.picture->rgba) << "other lines";
  edited([](preset::Preset& p) { environment::settings(p).segmentation = SegmentMethod::thesis; });
  EXPECT_EQ(model.shown().cut_error, before.quality[1][6]);
  edited([](preset::Preset& p) { environment::settings(p).threshold = 0.05; });
  EXPECT_THAT(model.shown().cut->segmentation.lights, SizeIs(::testing::Lt(20u))) << "of 48";
  EXPECT_EQ(model.maps_read(), 1);
  EXPECT_EQ(model.cuts_made(), 4);
  shown_of(preset, {MapLayout::cube, 80});
  EXPECT_EQ(model.shown().picture->rgba.size(), 4u * 80 * 60);
  EXPECT_EQ(model.cuts_made(), 4);
  edited([](preset::Preset& p) { p.scene.environment->file = "night.exr"; });
  EXPECT_EQ(model.maps_read(), 2);
  EXPECT_NE(model.shown().quality, before.quality);
}

// Another map while the quality of the first is in the making: nothing of the first is left.
TEST_F(EnvironmentModelTest, AnotherMapEndsWhatIsInTheMaking)
{
  const ShownMap alone = shown_of(preset);
  for (const char* file : {"room.exr", "night.exr", "overcast.exr", "noon.exr"}) {
    preset.scene.environment->file = file;
    ASSERT_TRUE(
        test::eventually([&] { want(preset); }, [&] { return model.shown().source && model.shown().source->environment.file == file; }));
  }
  const ShownMap shown = shown_of(preset);
  EXPECT_EQ(shown.quality, alone.quality);
  EXPECT_EQ(shown.cut_error, alone.cut_error);
  EXPECT_EQ(shown.picture->rgba, alone.picture->rgba);
}

TEST_F(EnvironmentModelTest, OtherEnginesHaveAMapAndNoLights)
{
  const std::string text = R"({"engine": "spectral", "scene": {"environment": {"type": "file", "file": "noon.exr", "rotate_deg": 20}}})";
  const ShownMap shown = shown_of(preset::parse_preset(text, (folder.path() / "test.json").string()));
  EXPECT_TRUE(shown.map && shown.picture);
  EXPECT_FALSE(shown.cut || shown.cut_error);
  EXPECT_THAT(shown.quality[0], IsEmpty());
}

TEST_F(EnvironmentModelTest, AColourIsAMapToo)
{
  const ShownMap shown = edited([](preset::Preset& p) {
    p.scene.environment = preset::Environment{};
    p.scene.environment->type = preset::Environment::Type::constant;
    p.scene.environment->colour = {1, 0.5, 0.25};
  });
  ASSERT_TRUE(shown.map && shown.cut);
  EXPECT_EQ(shown.map->width, 1);
  EXPECT_THAT(shown.cut->segmentation.lights, SizeIs(24));
}

TEST_F(EnvironmentModelTest, WhatIsNoMapIsOneLine)
{
  const auto expect_error = [&](const std::string& file, const std::string& what) {
    const ShownMap shown = edited([&](preset::Preset& p) { p.scene.environment->file = file; });
    EXPECT_THAT(shown.error, AllOf(HasSubstr(what), Not(HasSubstr("\n")))) << file;
    EXPECT_FALSE(shown.map || shown.cut || shown.picture) << file;
    EXPECT_TRUE(shown.source) << "it is of this map";
  };
  const scene::Environment nan{2, 1, {1, 1, 1, 1, std::nanf(""), 1}};
  image::write_exr(folder.path() / "nan.exr", {2, 1, {"R", "G", "B"}, nan.rgb, {}});
  folder.write("cut.exr", read_file(folder.path() / "noon.exr").substr(0, 400));
  expect_error("gone.exr", "test.json#/scene/environment/file");
  expect_error("nan.exr", "green of the texel in row 0, column 1");
  expect_error("cut.exr", "cut.exr");
  EXPECT_EQ(model.maps_read(), 0);
  const ShownMap mended = edited([](preset::Preset& p) { p.scene.environment->file = "room.exr"; });
  EXPECT_EQ(mended.error, "");
  EXPECT_TRUE(mended.map && mended.cut);
}

TEST_F(EnvironmentModelTest, AnOddShapeIsSaid)
{
  image::write_exr(folder.path() / "square.exr", {2, 2, {"R", "G", "B"}, std::vector<float>(12, 1), {}});
  const ShownMap shown = edited([](preset::Preset& p) { p.scene.environment->file = "square.exr"; });
  ASSERT_TRUE(shown.map && shown.cut);
  EXPECT_THAT(shown.map->warnings, ::testing::ElementsAre(HasSubstr("2 x 2 texels")));
}

// A black map has no lights; nothing is wrong with it.
TEST_F(EnvironmentModelTest, ABlackMapHasNoLights)
{
  image::write_exr(folder.path() / "black.exr", {2, 1, {"R", "G", "B"}, std::vector<float>(6, 0), {}});
  const ShownMap shown = edited([](preset::Preset& p) { p.scene.environment->file = "black.exr"; });
  ASSERT_TRUE(shown.cut);
  EXPECT_THAT(shown.cut->segmentation.lights, IsEmpty());
  EXPECT_EQ(shown.cut_error, 0);
}

} // namespace nephroid::ui::environment_model_test
