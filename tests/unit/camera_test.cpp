// SPDX-License-Identifier: Apache-2.0
// The camera's frame and pixel rays against values worked out by hand, and what it refuses.
#include "tests/support/errors.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::scene::camera_test {

Scene empty_scene(const glm::dvec3& origin = {0, 0, 0})
{
  Scene scene;
  scene.source = "p.json";
  scene.origin = origin;
  return scene;
}

/// The direction through the picture at (x, y) pixels from its top left corner: pixel (i, j) has its centre at (i + .5, j + .5).
glm::dvec3 direction(const Camera& c, double x, double y)
{
  return glm::dvec3(c.forward) + (2 * x / c.width - 1) * c.tan_x * glm::dvec3(c.right) +
         (1 - 2 * y / c.height) * c.tan_y * glm::dvec3(c.up);
}

// From (0, 0, 5) to the origin, 90 degrees high, 400 x 200 pixels: the plane z = 4, at distance 1, is seen from x = -2 to 2 and
// from y = -1 to 1. Row 0 is the top, column 0 the left.
TEST(Camera, CornersOfThePicture)
{
  preset::Camera preset;
  preset.position = {0, 0, 5};
  preset.fov_deg = 90;
  preset.resolution = {400, 200};
  const Camera camera = make_camera(preset, empty_scene());
  expect_near(direction(camera, 0, 0), {-2, 1, -1});
  expect_near(direction(camera, 400, 0), {2, 1, -1});
  expect_near(direction(camera, 0, 200), {-2, -1, -1});
  expect_near(direction(camera, 400, 200), {2, -1, -1});
  expect_near(direction(camera, 200, 100), {0, 0, -1});
  expect_near(direction(camera, 0.5, 0.5), {-1.995, 0.995, -1}); // the centre of the first pixel
}

// Straight down with up = +x: the picture's right is forward x up = (-y) x (+x) = +z.
TEST(Camera, LooksDown)
{
  preset::Camera preset;
  preset.position = {1, 10, 2};
  preset.target = {1, 3, 2};
  preset.up = {5, 0.5, 0}; // only its part across the view counts
  const Camera camera = make_camera(preset, empty_scene());
  expect_near(camera.forward, {0, -1, 0});
  expect_near(camera.up, {1, 0, 0});
  expect_near(camera.right, {0, 0, 1});
  EXPECT_NEAR(camera.tan_y, std::tan(20 * M_PI / 180), 1e-12);
  EXPECT_DOUBLE_EQ(camera.tan_x, camera.tan_y);
}

TEST(Camera, KeepsItsPlaceFarAway)
{
  preset::Camera preset;
  preset.position = {1e6 + 0.001, 1e6, 1e6 + 0.002};
  preset.target = {1e6, 1e6, 1e6};
  const Camera camera = make_camera(preset, empty_scene({1e6, 1e6, 1e6}));
  expect_near(camera.position, {0.001, 0, 0.002}, 1e-9);
  expect_near(camera.forward, {-1 / std::sqrt(5), 0, -2 / std::sqrt(5)}, 1e-6);
}

void expect_refused(const preset::Camera& camera, const char* field)
{
  EXPECT_THAT(refusal_of([&] { make_camera(camera, empty_scene()); }), StartsWith(std::string("p.json#/scene/camera/") + field + ": "));
}

TEST(Camera, RefusesWhatIsNoView)
{
  preset::Camera bad;
  bad.target = bad.position;
  expect_refused(bad, "target");
  bad = {};
  bad.up = {0, -1, -4}; // away from (0, 1, 4) to the origin: along the view
  expect_refused(bad, "up");
  bad = {};
  bad.up = {0, 0, 0};
  expect_refused(bad, "up");
  bad = {};
  bad.position[1] = 1e12;
  expect_refused(bad, "position");
  bad = {};
  bad.target[1] = std::nan("");
  expect_refused(bad, "target");
}

} // namespace nephroid::scene::camera_test
