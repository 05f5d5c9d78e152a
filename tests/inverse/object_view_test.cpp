// SPDX-License-Identifier: Apache-2.0
// The object as the window shows it while it is designed: light's own ways through it, backwards.
#include "inverse/job.h"
#include "inverse/object_view.h"
#include "inverse/sheet.h"
#include "preset/read.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::object_view_test {

using namespace inverse;

/// 4 x 4 facets over a receiver of 4 x 4 cells, one of which is lit.
struct Scene {
  Layout layout{.facets = {4, 4}, .cells = {4, 4}, .distances = {200}};
  std::vector<glm::dvec2> slopes{16, glm::dvec2(0)};
  std::vector<double> heights = std::vector<double>(16);
  std::size_t lit = 0;

  std::shared_ptr<const job::Picture> seen_by(const preset::Camera& camera) const {
    std::vector<double> light(16);
    light[lit] = 1;
    return view_of({layout, slopes, heights, false, {grey_picture(light, 1, layout.cells)}}, camera);
  }
};

/// So far away that all pixels look along the light; a pixel a facet.
preset::Camera along_the_light() {
  preset::Camera camera;
  camera.position = {0, 0, 1e6};
  camera.up = {0, 1, 0};
  camera.fov_deg = glm::degrees(2 * std::atan(50 / 1e6));
  camera.resolution = {4, 4};
  return camera;
}

float red(const job::Picture& picture, std::size_t pixel) { return picture.rgb[3 * pixel]; }

// Light's way through a facet is the camera's: where the facet sends light, the camera sees. A window sees what is
// behind it.
TEST(ObjectView, AFacetShowsWhereItsLightGoes) {
  Scene scene;
  scene.lit = 6;
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(red(*scene.seen_by(along_the_light()), i) > 0.5f, i == 6) << i;
  for (std::size_t i = 0; i < 16; ++i) // all facets but one aim at the last cell
    if (i != 9) scene.slopes[i] = (scene.layout.middle_of_cell(15) - scene.layout.middle(i)) / 200.0;
  scene.slopes[9] = (scene.layout.middle_of_cell(0) - scene.layout.middle(9)) / 200.0;
  scene.lit = 15;
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(red(*scene.seen_by(along_the_light()), i) > 0.5f, i != 9) << i;
  scene.lit = 0;
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(red(*scene.seen_by(along_the_light()), i) > 0.5f, i == 9) << i;
}

// A facet in the corner of a round object is not there: the camera sees past it.
TEST(ObjectView, ARoundObjectHasNoCorners) {
  Scene scene;
  scene.slopes[0] = (scene.layout.middle_of_cell(15) - scene.layout.middle(0)) / 200.0;
  EXPECT_LT(red(*scene.seen_by(along_the_light()), 0), 0.5f);
  scene.layout.round = true;
  EXPECT_GT(red(*scene.seen_by(along_the_light()), 0), 0.5f);
  preset::Camera camera =
      along_the_light(); // from the side, where a ray meets the middle of the rim and one passes the corner
  camera.position = {-300, 0, 5};
  camera.target = {0, 0, 5};
  camera.resolution = {33, 33};
  EXPECT_THAT(scene.seen_by(camera)->rgb, testing::Each(testing::Ge(0)));
}

// Into its sides, along its front, from inside of it and from its own target, which sees nothing: none of these falls
// out of the object.
TEST(ObjectView, ACameraMayBeAnywhere) {
  const Scene scene;
  for (const auto& [position, target] : std::vector<std::pair<preset::Vec3, preset::Vec3>>{{{-300, 0, 5}, {0, 0, 5}},
                                                                                           {{0, 0, 5}, {0, 0, 0}},
                                                                                           {{0, -300, 10}, {0, 0, 10}},
                                                                                           {{0, 0, 0}, {1, 0, 0}},
                                                                                           {{0, 0, 5}, {0, 0, 5}}}) {
    preset::Camera camera = along_the_light();
    camera.position = position;
    camera.target = target;
    camera.fov_deg = 60;
    camera.resolution = {33, 33};
    EXPECT_THAT(scene.seen_by(camera)->rgb, SizeIs(33 * 33 * 3));
  }
}

// From below the receiver, past the object: the lit cell as it is, mirrored left to right.
TEST(ObjectView, AReceiverIsSeenFromBothSides) {
  Scene scene;
  scene.lit = 4;
  preset::Camera camera = along_the_light();
  camera.position = {0, 0, -1e6};
  const auto picture = scene.seen_by(camera);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(red(*picture, i) > 0.9f, i == 7) << i;
}

preset::Preset preset_with(const std::string& camera) {
  return preset::parse_preset(R"({"engine": "inverse", "unit": "mm", "scene": {"camera": )" + camera +
                                  R"(}, "inverse": {"facets": [16, 16], "cells": [8, 8], "index": 1.5, "receivers": [
    {"distance_mm": 100, "picture": {"type": "ring"}}, {"distance_mm": 300, "picture": {"type": "disc"}}]}, "stop": {"passes": 1}})",
                              "p.json");
}

TEST(ObjectView, ACameraThatNobodyPutSomewhereSeesAll) {
  const preset::Camera camera = view_camera(preset_with(R"({"resolution": [300, 200]})"));
  EXPECT_THAT(camera.resolution, ElementsAre(300, 200));
  const glm::dvec3 from(camera.position[0], camera.position[1], camera.position[2]), to(0, 0, -145);
  const glm::dvec3 ahead = glm::normalize(to - from);
  for (const double x : {-50, 50})
    for (const double y : {-50, 50})
      for (const double z : {10, -300}) {
        const glm::dvec3 way = glm::dvec3(x, y, z) - from;
        const double far = glm::dot(way, ahead);
        EXPECT_LT(glm::dot(way, {0, 0, 1}) - far * ahead.z, far * std::tan(glm::radians(20.0)));
        EXPECT_GT(far, 0);
      }
  const preset::Preset own = preset_with(R"({"position": [0, -300, 100], "resolution": [300, 200]})");
  EXPECT_EQ(view_camera(own), own.scene.camera);
}

// While it is designed, and another one for another camera; the sheet of pictures stays what is written.
TEST(ObjectView, ComesWithEverySnapshot) {
  preset::Preset p = preset_with(R"({"resolution": [60, 40]})");
  const auto job = make_job(p, make_plan(p), test::shared_context());
  const job::Snapshot first = job->snapshot();
  ASSERT_TRUE(first.in_view);
  EXPECT_EQ(first.in_view->width, 60);
  EXPECT_EQ(job->snapshot().in_view, first.in_view); // nothing has changed
  while (!job->finished()) job->advance();
  const job::Snapshot last = job->snapshot();
  EXPECT_NE(last.in_view->rgb, first.in_view->rgb);
  EXPECT_NE(last.in_view->rgb, last.picture->rgb);
  p.scene.camera.position = {0, -500, 50};
  ASSERT_TRUE(job->adopt(p));
  EXPECT_NE(job->snapshot().in_view->rgb, last.in_view->rgb);
  EXPECT_TRUE(job->finished());
}

} // namespace nephroid::object_view_test
