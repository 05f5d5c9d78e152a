// SPDX-License-Identifier: Apache-2.0
// Which object is under the mouse, by hand and against the scene that is loaded anew after objects were moved.
#include "ui/view/sight.h"

#include "seen_scene.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::ui::picking_test {

preset::Preset scene()
{
  preset::Preset preset = test::ball_over_floor(); // 0: a ball of radius 0.5, 1: the floor at y = -1
  preset.scene.objects.push_back(test::shape_object("box", preset::Shape::Type::box, "wall"));
  preset.scene.objects[2].transform = {{0.5, 2, 0.4}, {10, 20, 30}, {1.2, 0, -0.3}};
  preset.scene.camera.position = {0.5, 1, 4};
  preset.scene.camera.target = {0.3, 0, 0};
  preset.scene.camera.resolution = {64, 48};
  return preset;
}

Sight sight(const preset::Preset& preset) { return *make_sight(preset.scene.camera, {}, preset.scene.camera.resolution); }

/// The object at each pixel's centre.
std::vector<std::optional<std::size_t>> picture(const SeenScene& seen, const preset::Preset& preset)
{
  std::vector<std::optional<std::size_t>> all;
  const Sight s = sight(preset);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) all.push_back(object_at(seen, preset, s.ray({x + 0.5, y + 0.5})));
  return all;
}

TEST(Picking, FindsABallWhereItIs)
{
  const preset::Preset preset = scene();
  const auto seen = test::seen_scene(preset);
  const Sight s = sight(preset);
  int on_ball = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const Ray ray = s.ray({x + 0.5, y + 0.5});
      const glm::dvec3 way = glm::normalize(ray.direction);
      const double passes = glm::length(ray.origin - glm::dot(ray.origin, way) * way); // by the ball's middle, the origin
      const auto object = object_at(*seen, preset, ray);
      if (std::abs(passes - 0.5) < 1e-3) continue;  // on its rim
      const bool hidden = object == std::size_t{2}; // by the box
      EXPECT_EQ(object == std::size_t{0}, passes < 0.5 && !hidden) << x << ' ' << y;
      on_ball += object == std::size_t{0};
    }
  EXPECT_GT(on_ball, 100);
  EXPECT_EQ(object_at(*seen, preset, {{0, 3, 3}, {0, 1, 0}}), std::nullopt) << "up into the sky";
}

TEST(Picking, FindsWhatMovedWithoutLoading)
{
  const preset::Preset before = scene();
  preset::Preset now = before;
  now.scene.objects[0].transform = {{1.3, 0.7, 1}, {0, 0, 40}, {-0.6, 0.4, 0.5}};
  now.scene.objects[2].transform = {{-0.5, 1, 0.8}, {0, 50, 0}, {0.3, -0.4, 0}};
  const auto stale = picture(*test::seen_scene(before), now), fresh = picture(*test::seen_scene(now), now);
  int different = 0, moved = 0;
  const auto old = picture(*test::seen_scene(before), before);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    different += stale[i] != fresh[i];
    moved += old[i] != fresh[i];
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(moved, 200) << "the test looks at something";
}

TEST(Picking, DoesNotFindWhatIsNotLoaded)
{
  const preset::Preset before = scene();
  const auto seen = test::seen_scene(before);
  const Ray at_ball{{0, 0, 4}, {0, 0, -1}};
  ASSERT_EQ(object_at(*seen, before, at_ball), std::size_t{0});
  preset::Preset now = before;
  now.scene.objects[0].shape->radius = 0.2; // until it is loaded again
  EXPECT_NE(object_at(*seen, now, at_ball), std::size_t{0});
  now.scene.objects.clear();
  EXPECT_EQ(object_at(*seen, now, at_ball), std::nullopt);
}

TEST(Picking, KnowsTheBoxAboutAnObject)
{
  const preset::Preset preset = scene();
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

} // namespace nephroid::ui::picking_test
