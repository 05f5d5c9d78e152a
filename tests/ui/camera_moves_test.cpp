// SPDX-License-Identifier: Apache-2.0
// The mouse's camera moves against where a pinhole camera must then be, and see, by hand.
#include "tests/support/test.h"
#include "ui/view/camera.h"

#include <glm/glm.hpp>

namespace nephroid::ui::camera_moves_test {

constexpr double tolerance = 1e-9;

preset::Camera at(double x, double y, double z)
{
  preset::Camera camera;
  camera.position = {x, y, z};
  camera.target = {0, 0, 0};
  camera.fov_deg = 90;
  camera.resolution = {200, 100};
  return camera;
}

glm::dvec3 vector(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }

void expect_near(const preset::Vec3& v, double x, double y, double z)
{
  EXPECT_NEAR(v[0], x, tolerance);
  EXPECT_NEAR(v[1], y, tolerance);
  EXPECT_NEAR(v[2], z, tolerance);
}

/// Where a point is in the picture, right and down from its middle, in parts of its height (the convention of scene::Camera).
std::array<double, 2> seen(const preset::Camera& camera, const glm::dvec3& point)
{
  const glm::dvec3 forward = glm::normalize(vector(camera.target) - vector(camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, vector(camera.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dvec3 to = point - vector(camera.position);
  const double height = 2 * std::tan(glm::radians(camera.fov_deg) / 2) * glm::dot(to, forward);
  return {glm::dot(to, right) / height, -glm::dot(to, up) / height};
}

TEST(CameraMoves, OrbitGoesRoundTheTarget)
{
  expect_near(orbit(at(0, 0, 4), 90, 0).position, 4, 0, 0); // from +z, looking along -z, right is +x
  expect_near(orbit(at(0, 0, 4), -90, 0).position, -4, 0, 0);
  expect_near(orbit(at(0, 0, 4), 0, 30).position, 0, 2, 4 * std::cos(glm::radians(30.0)));
  expect_near(orbit(at(0, 0, 4), 180, 0).position, 0, 0, -4);
}

TEST(CameraMoves, OrbitKeepsDistanceTargetAndWayBack)
{
  preset::Camera camera = at(1, 2, 3);
  camera.target = {0.5, -1, 0.25};
  const preset::Camera moved = orbit(camera, 33, -21);
  EXPECT_EQ(moved.target, camera.target);
  EXPECT_NEAR(glm::distance(vector(moved.position), vector(moved.target)), glm::distance(vector(camera.position), vector(camera.target)),
              tolerance);
  const preset::Camera back = orbit(orbit(moved, 0, 21), -33, 0);
  expect_near(back.position, 1, 2, 3);
}

TEST(CameraMoves, OrbitStopsShortOfThePoles)
{
  const preset::Camera top = orbit(at(0, 0, 4), 0, 1000);
  EXPECT_NEAR(top.position[1], 4 * std::cos(glm::radians(1.0)), tolerance);
  EXPECT_GT(top.position[2], 0); // not flipped to the other side
  const preset::Camera bottom = orbit(at(0, 0, 4), 0, -1000);
  EXPECT_NEAR(bottom.position[1], -4 * std::cos(glm::radians(1.0)), tolerance);
}

TEST(CameraMoves, OrbitFromAPoleAndWithoutADistanceStaysFinite)
{
  for (const preset::Camera& camera : {at(0, 3, 0), at(0, 0, 0)})
    for (double c : orbit(camera, 20, 10).position) EXPECT_TRUE(std::isfinite(c));
}

TEST(CameraMoves, DollyScalesTheDistance)
{
  preset::Camera camera = at(1, 2, 3);
  camera.target = {1, 1, 1};
  expect_near(dolly(camera, 0.5).position, 1, 1.5, 2);
  expect_near(dolly(dolly(camera, 0.8), 1 / 0.8).position, 1, 2, 3);
}

TEST(CameraMoves, PanMovesTheTargetsPictureByWhatWasAsked)
{
  const preset::Camera camera = at(1, 2, 3);
  const preset::Camera moved = pan(camera, 0.25, 0.125);
  const auto where = seen(moved, vector(camera.target));
  EXPECT_NEAR(where[0], 0.25, tolerance);
  EXPECT_NEAR(where[1], 0.125, tolerance);
  EXPECT_NEAR(glm::distance(vector(moved.position), vector(moved.target)), glm::distance(vector(camera.position), vector(camera.target)),
              tolerance);
}

TEST(CameraMoves, OrbitToTheLeftTurnsTheSceneToTheRight)
{
  // What is in front of the target comes to the right when the camera goes to the left: the scene follows the mouse.
  EXPECT_GT(seen(orbit(at(0, 0, 4), -10, 0), {0, 0, 1})[0], 0);
  EXPECT_GT(seen(orbit(at(0, 0, 4), 0, 10), {0, 0, 1})[1], 0);
}

} // namespace nephroid::ui::camera_moves_test
