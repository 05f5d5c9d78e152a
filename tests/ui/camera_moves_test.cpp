// SPDX-License-Identifier: Apache-2.0
// The View's geometry: the mouse's camera moves against where a pinhole camera must then be, and see, by hand; where
// the picture lies; which object is under the mouse, also after objects were moved.
#include "scenes.h"
#include "tests/support/loaded_scenes.h"
#include "ui/view/pinhole.h"
#include "ui/view/placement.h"
#include <glm/glm.hpp>

namespace nephroid::ui::camera_moves_test {

constexpr double tolerance = 1e-9;

preset::Camera at(double x, double y, double z) {
  return {.position = {x, y, z}, .target = {0, 0, 0}, .fov_deg = 90, .resolution = {200, 100}};
}

glm::dvec3 vector(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }

void expect_near(const preset::Vec3& v, double x, double y, double z) {
  EXPECT_NEAR(v[0], x, tolerance);
  EXPECT_NEAR(v[1], y, tolerance);
  EXPECT_NEAR(v[2], z, tolerance);
}

/// Where a point is in the picture, right and down from its middle, in parts of its height (the convention of
/// scene::Camera).
std::array<double, 2> seen(const preset::Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 forward = glm::normalize(vector(camera.target) - vector(camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, vector(camera.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dvec3 to = point - vector(camera.position);
  const double height = 2 * std::tan(glm::radians(camera.fov_deg) / 2) * glm::dot(to, forward);
  return {glm::dot(to, right) / height, -glm::dot(to, up) / height};
}

TEST(CameraMoves, OrbitGoesRoundTheTarget) {
  expect_near(orbit(at(0, 0, 4), 90, 0).position, 4, 0, 0); // from +z, looking along -z, right is +x
  expect_near(orbit(at(0, 0, 4), -90, 0).position, -4, 0, 0);
  expect_near(orbit(at(0, 0, 4), 0, 30).position, 0, 2, 4 * std::cos(glm::radians(30.0)));
  expect_near(orbit(at(0, 0, 4), 180, 0).position, 0, 0, -4);
}

TEST(CameraMoves, OrbitKeepsDistanceTargetAndWayBack) {
  preset::Camera camera = at(1, 2, 3);
  camera.target = {0.5, -1, 0.25};
  const preset::Camera moved = orbit(camera, 33, -21);
  EXPECT_EQ(moved.target, camera.target);
  EXPECT_NEAR(glm::distance(vector(moved.position), vector(moved.target)),
              glm::distance(vector(camera.position), vector(camera.target)), tolerance);
  const preset::Camera back = orbit(orbit(moved, 0, 21), -33, 0);
  expect_near(back.position, 1, 2, 3);
}

TEST(CameraMoves, OrbitStopsShortOfThePoles) {
  const preset::Camera top = orbit(at(0, 0, 4), 0, 1000);
  EXPECT_NEAR(top.position[1], 4 * std::cos(glm::radians(1.0)), tolerance);
  EXPECT_GT(top.position[2], 0); // not flipped to the other side
  const preset::Camera bottom = orbit(at(0, 0, 4), 0, -1000);
  EXPECT_NEAR(bottom.position[1], -4 * std::cos(glm::radians(1.0)), tolerance);
}

TEST(CameraMoves, OrbitFromAPoleAndWithoutADistanceStaysFinite) {
  for (const preset::Camera& camera : {at(0, 3, 0), at(0, 0, 0)})
    for (double c : orbit(camera, 20, 10).position) EXPECT_TRUE(std::isfinite(c));
}

TEST(CameraMoves, DollyScalesTheDistance) {
  preset::Camera camera = at(1, 2, 3);
  camera.target = {1, 1, 1};
  expect_near(dolly(camera, 0.5).position, 1, 1.5, 2);
  expect_near(dolly(dolly(camera, 0.8), 1 / 0.8).position, 1, 2, 3);
}

TEST(CameraMoves, PanMovesTheTargetsPictureByWhatWasAsked) {
  const preset::Camera camera = at(1, 2, 3);
  const preset::Camera moved = pan(camera, 0.25, 0.125);
  const auto where = seen(moved, vector(camera.target));
  EXPECT_NEAR(where[0], 0.25, tolerance);
  EXPECT_NEAR(where[1], 0.125, tolerance);
  EXPECT_NEAR(glm::distance(vector(moved.position), vector(moved.target)),
              glm::distance(vector(camera.position), vector(camera.target)), tolerance);
}

// With a shift and without perspective a point of the screen and its ray are each other's, and a pan and a dolly do
// what they say.
TEST(CameraMoves, ShiftedAndParallelPicturesAreHeldAsTheyAreShown) {
  for (const bool orthographic : {false, true}) {
    preset::Camera camera = at(0, 0, 4);
    camera.shift = {0.25, -0.125};
    if (orthographic) {
      camera.projection = preset::Camera::Projection::orthographic;
      camera.height = 2;
    }
    const auto place_of = [](const preset::Camera& c, const glm::dvec3& point) {
      return *make_pinhole(c, Placement{}, {200, 100})->to_screen(point);
    };
    const Point middle = place_of(camera, {0, 0, 0}); // the shift's part of the picture away from its middle
    EXPECT_NEAR(middle[0], 50, tolerance);
    EXPECT_NEAR(middle[1], 37.5, tolerance);
    const Ray ray = make_pinhole(camera, Placement{}, {200, 100})->ray({120, 20});
    const Point back = place_of(camera, ray.origin + 3.0 * ray.direction);
    EXPECT_NEAR(back[0], 120, tolerance);
    EXPECT_NEAR(back[1], 20, tolerance);
    const Point moved = place_of(pan(camera, 0.25, 0.125), {0, 0, 0});
    EXPECT_NEAR(moved[0], 75, tolerance);
    EXPECT_NEAR(moved[1], 50, tolerance);
    const Point near = place_of(dolly(camera, 0.5), {0, 0.5, 0}), far = place_of(camera, {0, 1, 0});
    EXPECT_NEAR(near[1], far[1], tolerance);
  }
}

TEST(CameraMoves, OrbitToTheLeftTurnsTheSceneToTheRight) {
  // What is in front of the target comes to the right when the camera goes to the left: the scene follows the mouse.
  EXPECT_GT(seen(orbit(at(0, 0, 4), -10, 0), {0, 0, 1})[0], 0);
  EXPECT_GT(seen(orbit(at(0, 0, 4), 0, 10), {0, 0, 1})[1], 0);
}

const Canvas canvas{{100, 50}, {800, 600}};
const std::array<int, 2> picture{400, 200};

TEST(Placement, FitShowsTheWholePictureInTheMiddle) {
  const Placement p = place(ViewSettings{}, canvas, picture);
  EXPECT_DOUBLE_EQ(p.scale, 2);
  EXPECT_EQ(p.to_screen({0, 0}), (Point{100, 150}));
  EXPECT_EQ(p.to_screen({400, 200}), (Point{900, 550}));
}

TEST(Placement, ZoomKeepsThePointUnderTheCursor) {
  const Point cursor{333, 222};
  ViewSettings view_settings;
  const Point before = place(view_settings, canvas, picture).to_picture(cursor);
  for (double factor : {1.3, 1.3, 2.0, 0.5, 0.1}) {
    view_settings = zoomed(view_settings, canvas, picture, cursor, factor);
    const Placement p = place(view_settings, canvas, picture);
    const Point after = p.to_picture(cursor);
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(after[axis], before[axis], 0.51 / p.scale); // whole pixels of the screen
  }
  EXPECT_NEAR(view_settings.zoom, 2 * 1.3 * 1.3 * 2.0 * 0.5 * 0.1, 1e-12);
  EXPECT_FALSE(view_settings.fit);
}

TEST(Placement, ZoomIsBounded) {
  ViewSettings view_settings;
  for (int i = 0; i < 100; ++i) view_settings = zoomed(view_settings, canvas, picture, {400, 300}, 10);
  EXPECT_EQ(view_settings.zoom, 256);
  for (int i = 0; i < 100; ++i) view_settings = zoomed(view_settings, canvas, picture, {400, 300}, 0.1);
  EXPECT_EQ(view_settings.zoom, 1.0 / 64);
}

TEST(Placement, DraggingMovesThePictureWithTheMouse) {
  const ViewSettings view_settings = dragged(ViewSettings{}, canvas, picture, {30, -12});
  const Point moved = place(view_settings, canvas, picture).to_screen({0, 0});
  EXPECT_EQ(moved, (Point{130, 138}));
}

TEST(Placement, PixelsAreFoundByTheirSquares) {
  const Placement p = place(ViewSettings{}, canvas, picture);
  EXPECT_EQ(pixel_at(p, picture, {100, 150}), (std::array<int, 2>{0, 0}));
  EXPECT_EQ(pixel_at(p, picture, {101.9, 151.9}), (std::array<int, 2>{0, 0}));
  EXPECT_EQ(pixel_at(p, picture, {102, 150}), (std::array<int, 2>{1, 0}));
  EXPECT_EQ(pixel_at(p, picture, {899, 549}), (std::array<int, 2>{399, 199}));
  EXPECT_EQ(pixel_at(p, picture, {99.9, 150}), std::nullopt);
  EXPECT_EQ(pixel_at(p, picture, {900, 150}), std::nullopt);
}

preset::Preset picked_preset() {
  preset::Preset preset = test::ball_over_floor(); // 0: a ball of radius 0.5, 1: the floor at y = -1
  preset.scene.objects.push_back(test::shape_object("box", preset::Shape::Type::box, "wall"));
  preset.scene.objects[2].transform = {{0.5, 2, 0.4}, {10, 20, 30}, {1.2, 0, -0.3}};
  preset.scene.camera = {.position = {0.5, 1, 4}, .target = {0.3, 0, 0}, .resolution = {64, 48}};
  return preset;
}

Pinhole pinhole_of(const preset::Preset& preset) {
  return *make_pinhole(preset.scene.camera, {}, preset.scene.camera.resolution);
}

/// The object at each pixel's centre.
std::vector<std::optional<std::size_t>> objects_in(const ViewedScene& seen, const preset::Preset& preset) {
  std::vector<std::optional<std::size_t>> all;
  const Pinhole s = pinhole_of(preset);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) all.push_back(object_at(seen, preset, s.ray({x + 0.5, y + 0.5})));
  return all;
}

TEST(Picking, FindsABallWhereItIs) {
  const preset::Preset preset = picked_preset();
  const auto seen = test::seen_scene(preset);
  const Pinhole s = pinhole_of(preset);
  int on_ball = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const Ray ray = s.ray({x + 0.5, y + 0.5});
      const glm::dvec3 way = glm::normalize(ray.direction);
      const double passes =
          glm::length(ray.origin - glm::dot(ray.origin, way) * way); // by the ball's middle, the origin
      const auto object = object_at(*seen, preset, ray);
      if (std::abs(passes - 0.5) < 1e-3) continue;  // on its rim
      const bool hidden = object == std::size_t{2}; // by the box
      EXPECT_EQ(object == std::size_t{0}, passes < 0.5 && !hidden) << x << ' ' << y;
      on_ball += object == std::size_t{0};
    }
  EXPECT_GT(on_ball, 100);
  EXPECT_EQ(object_at(*seen, preset, {{0, 3, 3}, {0, 1, 0}}), std::nullopt) << "up into the sky";
}

TEST(Picking, FindsWhatMovedWithoutLoading) {
  const preset::Preset before = picked_preset();
  preset::Preset now = before;
  now.scene.objects[0].transform = {{1.3, 0.7, 1}, {0, 0, 40}, {-0.6, 0.4, 0.5}};
  now.scene.objects[2].transform = {{-0.5, 1, 0.8}, {0, 50, 0}, {0.3, -0.4, 0}};
  const auto stale = objects_in(*test::seen_scene(before), now), fresh = objects_in(*test::seen_scene(now), now);
  int different = 0, moved = 0;
  const auto old = objects_in(*test::seen_scene(before), before);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    different += stale[i] != fresh[i];
    moved += old[i] != fresh[i];
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(moved, 200) << "the test looks at something";
}

TEST(Picking, DoesNotFindWhatIsNotLoaded) {
  const preset::Preset before = picked_preset();
  const auto seen = test::seen_scene(before);
  const Ray at_ball{{0, 0, 4}, {0, 0, -1}};
  ASSERT_EQ(object_at(*seen, before, at_ball), std::size_t{0});
  preset::Preset now = before;
  now.scene.objects[0].shape->radius = 0.2; // until it is loaded again
  EXPECT_NE(object_at(*seen, now, at_ball), std::size_t{0});
  now.scene.objects.clear();
  EXPECT_EQ(object_at(*seen, now, at_ball), std::nullopt);
}

TEST(Picking, KnowsTheBoxAboutAnObject) {
  const preset::Preset preset = picked_preset();
  const auto seen = test::seen_scene(preset);
  const auto ball = local_box(seen.get(), preset, 0), box = local_box(seen.get(), preset, 2);
  ASSERT_TRUE(ball && box);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ball->low[i], -0.5, 1e-6);
    EXPECT_NEAR(ball->high[i], 0.5, 1e-6);
    EXPECT_NEAR(box->low[i], -0.5, 1e-6) << "of size 1 before its transform";
    EXPECT_NEAR(box->high[i], 0.5, 1e-6);
  }
  EXPECT_EQ(pivot_of(seen.get(), preset, 2), glm::dvec3(0)) << "of a shape, exactly";
  EXPECT_FALSE(local_box(seen.get(), preset, 3));
  EXPECT_FALSE(local_box(nullptr, preset, 0));
}

} // namespace nephroid::ui::camera_moves_test
