// SPDX-License-Identifier: Apache-2.0
// What the panel "Environment" shows, without a window: what is made anew when, held against the engine's own
// functions; maps that are not there or not maps; the map as a flat picture: places of directions, lines between
// regions; figures of its lights; drags.
#include "environment/segment/irradiance.h"
#include "environment/settings.h"
#include "image/image.h"
#include "preset/read.h"
#include "tests/environment/maps.h"
#include "ui/environment/model.h"

namespace nephroid::ui::environment_model_test {

using environment::SegmentMethod;

class EnvironmentModelTest : public testing::Test {
protected:
  EnvironmentModelTest() {
    for (const auto& [name, map] : test::synthetic_maps(128))
      image::write_exr(folder.path() / (name + ".exr"), {map.width, map.height, {"R", "G", "B"}, map.rgb, {}});
    preset = preset::parse_preset(R"({"engine": "environment", "scene": {"environment": "noon.exr"}})",
                                  (folder.path() / "test.json").string());
  }
  ShownMap shown_of(const preset::Preset& wanted, const MapPictureSize& size = {MapLayout::latitude_longitude, 64}) {
    want(wanted, size);
    EXPECT_TRUE(test::eventually([&] { want(wanted, size); }, [&] { return model.rests(); }));
    return model.shown();
  }
  /// As a frame does.
  void want(const preset::Preset& wanted, const MapPictureSize& size = {MapLayout::latitude_longitude, 64}) {
    tasks.collect(messages);
    model.want(wanted_map(wanted, size), tasks);
  }
  ShownMap edited(const std::function<void(preset::Preset&)>& change) {
    change(preset);
    return shown_of(preset);
  }

  test::TemporaryFolder folder;
  Messages messages;
  TaskQueue tasks;
  EnvironmentModel model;
  preset::Preset preset;
};

TEST_F(EnvironmentModelTest, HasWhatTheEngineHas) {
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

TEST_F(EnvironmentModelTest, MakesAnewWhatAnEditChanges) {
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
  EXPECT_THAT(model.shown().cut->segmentation.lights, SizeIs(Lt(20u))) << "of 48";
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
TEST_F(EnvironmentModelTest, AnotherMapEndsWhatIsInTheMaking) {
  const ShownMap alone = shown_of(preset);
  for (const char* file : {"room.exr", "night.exr", "overcast.exr", "noon.exr"}) {
    preset.scene.environment->file = file;
    ASSERT_TRUE(test::eventually(
        [&] { want(preset); }, [&] { return model.shown().source && model.shown().source->environment.file == file; }));
  }
  const ShownMap shown = shown_of(preset);
  EXPECT_EQ(shown.quality, alone.quality);
  EXPECT_EQ(shown.cut_error, alone.cut_error);
  EXPECT_EQ(shown.picture->rgba, alone.picture->rgba);
}

TEST_F(EnvironmentModelTest, OtherEnginesHaveAMapAndNoLights) {
  const std::string text =
      R"({"engine": "spectral", "scene": {"environment": {"type": "file", "file": "noon.exr", "rotate_deg": 20}}})";
  const ShownMap shown = shown_of(preset::parse_preset(text, (folder.path() / "test.json").string()));
  EXPECT_TRUE(shown.map && shown.picture);
  EXPECT_FALSE(shown.cut || shown.cut_error);
  EXPECT_THAT(shown.quality[0], IsEmpty());
}

TEST_F(EnvironmentModelTest, AColourIsAMapToo) {
  const ShownMap shown = edited([](preset::Preset& p) {
    p.scene.environment = preset::Environment{};
    p.scene.environment->type = preset::Environment::Type::constant;
    p.scene.environment->colour = {1, 0.5, 0.25};
  });
  ASSERT_TRUE(shown.map && shown.cut);
  EXPECT_EQ(shown.map->width, 1);
  EXPECT_THAT(shown.cut->segmentation.lights, SizeIs(24));
}

TEST_F(EnvironmentModelTest, WhatIsNoMapIsOneLine) {
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

TEST_F(EnvironmentModelTest, AnOddShapeIsSaid) {
  image::write_exr(folder.path() / "square.exr", {2, 2, {"R", "G", "B"}, std::vector<float>(12, 1), {}});
  const ShownMap shown = edited([](preset::Preset& p) { p.scene.environment->file = "square.exr"; });
  ASSERT_TRUE(shown.map && shown.cut);
  EXPECT_THAT(shown.map->warnings, ElementsAre(HasSubstr("2 x 2 texels")));
}

// A black map has no lights; nothing is wrong with it.
TEST_F(EnvironmentModelTest, ABlackMapHasNoLights) {
  image::write_exr(folder.path() / "black.exr", {2, 1, {"R", "G", "B"}, std::vector<float>(6, 0), {}});
  const ShownMap shown = edited([](preset::Preset& p) { p.scene.environment->file = "black.exr"; });
  ASSERT_TRUE(shown.cut);
  EXPECT_THAT(shown.cut->segmentation.lights, IsEmpty());
  EXPECT_EQ(shown.cut_error, 0);
}

constexpr MapLayout layouts[] = {MapLayout::latitude_longitude, MapLayout::cube};

glm::dvec3 direction_at(MapLayout layout, const glm::dvec2& at) {
  return glm::normalize(environment::position(cube_point(layout, at).value()));
}

TEST(MapPlaces, OfAxesAreKnown) {
  const auto expect_at = [](MapLayout layout, const glm::dvec3& direction, double x, double y) {
    const glm::dvec2 at = place_of(layout, direction);
    EXPECT_NEAR(at.x, x, 1e-12);
    EXPECT_NEAR(at.y, y, 1e-12);
  };
  const MapLayout flat = MapLayout::latitude_longitude, cross = MapLayout::cube;
  expect_at(flat, {0, 0, -1}, 0.5, 0.5);
  expect_at(flat, {2, 0, 0}, 0.75, 0.5);
  expect_at(flat, {-1, 0, -1}, 0.375, 0.5);
  expect_at(flat, direction_of(45, 0), 0.5, 0.25);
  expect_at(cross, {0, 0, -1}, 1.5 / 4, 0.5);
  expect_at(cross, {1, 0, 0}, 2.5 / 4, 0.5);
  expect_at(cross, {0, 0, 1}, 3.5 / 4, 0.5);
  expect_at(cross, {-1, 0, 0}, 0.5 / 4, 0.5);
  expect_at(cross, {0, 1, 0}, 1.5 / 4, 0.5 / 3);
  expect_at(cross, {0, -1, 0}, 1.5 / 4, 2.5 / 3);
  expect_at(cross, {0.5, 0.5, -1}, 1.75 / 4, 1.25 / 3); // to the right and up as seen from inside
}

TEST(MapPlaces, GoThereAndBack) {
  for (const MapLayout layout : layouts)
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 direction = direction_of(std::fmod(37.3 * i, 179.0) - 89.5, std::fmod(101.7 * i, 359.0) - 179.5);
      EXPECT_LT(glm::distance(direction_at(layout, place_of(layout, direction)), direction), 1e-9) << i;
    }
  EXPECT_FALSE(cube_point(MapLayout::cube, {0.1, 0.1})) << "beside the cross";
  EXPECT_FALSE(cube_point(MapLayout::latitude_longitude, {1, 0.1}));
  EXPECT_FALSE(cube_point(MapLayout::cube, {std::nan(""), 0.5}));
}

// Faces that touch in the cross touch in the cube, with the same side up.
TEST(MapPlaces, OfTheCrossAreContinuousAcrossFaces) {
  constexpr double step = 1e-6;
  for (double along = 0.05; along < 1; along += 0.1) {
    for (const double x : {0.25, 0.5, 0.75}) {
      const double y = (1 + along) / 3;
      EXPECT_LT(
          glm::distance(direction_at(MapLayout::cube, {x - step, y}), direction_at(MapLayout::cube, {x + step, y})),
          1e-4);
    }
    for (const double y : {1.0 / 3, 2.0 / 3}) {
      const double x = (1 + along) / 4;
      EXPECT_LT(
          glm::distance(direction_at(MapLayout::cube, {x, y - step}), direction_at(MapLayout::cube, {x, y + step})),
          1e-4);
    }
    const double y = (1 + along) / 3; // the right edge goes on at the left
    EXPECT_LT(glm::distance(direction_at(MapLayout::cube, {step, y}), direction_at(MapLayout::cube, {1 - step, y})),
              1e-4);
  }
}

scene::Environment lamp(double elevation_deg, double azimuth_deg, double radius_deg) {
  return test::made_map(256, 128, [&](const glm::dvec3& d) {
    return test::sky_with_lamps(d, glm::dvec3(0.2), glm::dvec3(0.1),
                                {{elevation_deg, azimuth_deg, radius_deg, {900, 900, 900}}});
  });
}

TEST(MapPicture, ShowsALampWhereItIs) {
  const environment::SegmentPicture map = environment::shown_map(lamp(30, 70, 1));
  for (const MapLayout layout : layouts) {
    const MapPictureSize size{layout, 120}; // a pixel is three degrees wide
    const std::vector<unsigned char> rgba = drawn(size, colours_under(size, map), texels_under(size, 128), {});
    ASSERT_EQ(rgba.size(), 4u * 120 * static_cast<unsigned>(size.height()));
    glm::dvec2 sum{0};
    double count = 0;
    int transparent = 0;
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
      transparent += rgba[4 * i + 3] == 0;
      if (rgba[4 * i] < 150) continue; // the sky is below 140
      sum += glm::dvec2(static_cast<double>(i % 120) + 0.5, std::floor(static_cast<double>(i) / 120) + 0.5);
      ++count;
    }
    ASSERT_GE(count, 1);
    EXPECT_LE(count, 6);
    const glm::dvec2 at = place_of(layout, direction_of(30, 70));
    EXPECT_NEAR(sum.x / count, 120 * at.x, 1);
    EXPECT_NEAR(sum.y / count, size.height() * at.y, 1);
    EXPECT_EQ(transparent, layout == MapLayout::cube ? 120 * 90 / 2 : 0) << "half of the cross is no face";
  }
}

// Two regions a face, cut in the middle: a line is where two neighbouring pixels lie in different regions, and nowhere
// else.
TEST(MapPicture, LinesAreBetweenRegions) {
  const scene::Environment map = test::uniform_map(256, 128);
  const environment::CubeMap cube = environment::make_cube_map(map);
  const environment::Segmentation cut = environment::segment(cube, {.lights = 12});
  const MapPictureSize size{MapLayout::cube, 160};
  const std::vector<int> texels = texels_under(size, cube.size), regions = regions_of_texels(cut);
  const std::vector<Colour> colours = colours_under(size, environment::shown_map(map));
  const auto with = drawn(size, colours, texels, regions), without = drawn(size, colours, texels, {});
  int lines = 0;
  for (std::size_t i = 0; i < texels.size(); ++i)
    lines += with[4 * i] != without[4 * i] || with[4 * i + 1] != without[4 * i + 1];
  // 40 pixels a side of a face: one line through each of six faces, and the six edges where faces touch in the cross,
  // 40 pixels each, less where two lines meet.
  EXPECT_LE(lines, 12 * 40);
  EXPECT_GT(lines, 12 * 40 - 12);
  std::vector<int> texels_of_light(12);
  for (const int region : regions) ++texels_of_light.at(static_cast<std::size_t>(region));
  for (const int texels_of_one : texels_of_light) EXPECT_EQ(texels_of_one, cube.size * cube.size / 2);
}

TEST(LightFigures, AreTheMapsInTheScene) {
  const scene::Environment map = test::made_map(256, 128, [&](const glm::dvec3& d) {
    return test::sky_with_lamps(d, glm::dvec3(0), glm::dvec3(0),
                                {{30, 70, 4, {900, 600, 300}}, {-20, 170, 4, {0, 0, 500}}});
  });
  const environment::Segmentation cut = environment::segment(environment::make_cube_map(map), {.lights = 8});
  const std::vector<RegionFigures> figures = figures_of(cut, 2.5, 40, {});
  ASSERT_EQ(figures.size(), cut.lights.size() + cut.dropped.size());
  double flux = 0, share = 0, sr = 0;
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    sr += figures[i].solid_angle_sr;
    EXPECT_FALSE(figures[i].occluded);
    if (i >= cut.lights.size()) continue;
    flux += figures[i].flux;
    share += figures[i].share;
    if (figures[i].flux > figures[brightest].flux) brightest = i;
  }
  EXPECT_NEAR(flux, 2.5 * environment::luminance(test::flux_of_texels(map)), 1e-9 * flux);
  EXPECT_NEAR(share, 1, 1e-12);
  EXPECT_NEAR(sr, 4 * test::pi, 1e-9);
  // Counterclockwise as seen from above is towards the left: smaller azimuths. The lamp has a part of two regions at
  // most.
  EXPECT_NEAR(figures[brightest].azimuth_deg, 70 - 40, 4);
  EXPECT_NEAR(figures[brightest].elevation_deg, 30, 4);
  EXPECT_EQ(figures[brightest].colour[0], 255);
  EXPECT_GT(figures[brightest].colour[1], figures[brightest].colour[2]);
  const auto behind =
      std::find_if(figures.begin(), figures.end(), [](const RegionFigures& f) { return f.colour[2] == 255; });
  ASSERT_NE(behind, figures.end());
  EXPECT_NEAR(behind->azimuth_deg, 170 - 40, 4);
}

TEST(LightFigures, OfABlackMapAreNothing) {
  const auto cube = environment::make_cube_map(test::uniform_map(4, 2, glm::dvec3(0)));
  const std::vector<RegionFigures> figures = figures_of(environment::segment(cube, {}), 1, 0, {});
  ASSERT_THAT(figures, SizeIs(6)) << "six dropped faces";
  for (const RegionFigures& f : figures) {
    EXPECT_EQ(f.flux, 0);
    EXPECT_EQ(f.share, 0);
    EXPECT_THAT(f.colour, ElementsAre(0, 0, 0));
  }
}

TEST(LightFigures, TakeWhatIsHiddenFromTheRun) {
  job::Snapshot snapshot;
  EXPECT_THAT(visible_shares(snapshot, 2), IsEmpty());
  snapshot.curves = {{"cost", {"step", "visible"}, {{0, 0.1}, {1, 0.1}}},
                     {"lights", {"light", "azimuth_deg", "visible"}, {{1, 30, 0.25}, {2, -60, 1}}}};
  EXPECT_THAT(visible_shares(snapshot, 2), ElementsAre(0.25, 1));
  EXPECT_THAT(visible_shares(snapshot, 3), IsEmpty()) << "of another segmentation";
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    snapshot.curves[1].rows[1][2] = wrong;
    EXPECT_THAT(visible_shares(snapshot, 2), IsEmpty()) << wrong;
  }
  snapshot.curves[1].columns[2] = "seen";
  EXPECT_THAT(visible_shares(snapshot, 2), IsEmpty());
  const environment::Segmentation cut =
      environment::segment(environment::make_cube_map(lamp(30, 70, 4)), {.lights = 6});
  std::vector<double> visible(cut.lights.size(), 1);
  visible[1] = 0.25;
  const std::vector<RegionFigures> figures = figures_of(cut, 1, 0, visible);
  EXPECT_EQ(figures[0].occluded, 0);
  EXPECT_EQ(figures[1].occluded, 0.75);
}

TEST(MapDrags, TurnTheWayOfTheMouse) {
  const MapLayout flat = MapLayout::latitude_longitude;
  EXPECT_EQ(dragged_rotation(0, 0.25, flat), -90) << "to the right: clockwise as seen from above";
  EXPECT_EQ(dragged_rotation(10, -0.1, flat), 46);
  EXPECT_EQ(dragged_rotation(170, -0.1, flat), -154) << "once round is where it was";
  EXPECT_EQ(dragged_rotation(3600, 0, flat), 0);
  EXPECT_EQ(dragged_rotation(0, 0.25, MapLayout::cube), 90) << "a face";
  EXPECT_EQ(dragged_rotation(0, 1.0 / 3000, flat), -0.1);
}

} // namespace nephroid::ui::environment_model_test
