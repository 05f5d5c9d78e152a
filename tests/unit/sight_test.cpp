// SPDX-License-Identifier: Apache-2.0
// Where a look through a pixel ends, against Snell's law by hand.
#include "scene/bvh.h"
#include "spectral/sight.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/presets.h"

namespace nephroid::sight_test {

constexpr double n = 1.5, degree = std::numbers::pi / 180;

/// A camera of one pixel at the origin; glass of n = 1.5, a mirror, a wall.
preset::Preset one_pixel(preset::Vec3 target)
{
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials["glass"] = test::glass(n);
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["wall"];
  p.scene.camera.position = {0, 0, 0};
  p.scene.camera.target = target;
  p.scene.camera.fov_deg = 1;
  p.scene.camera.resolution = {1, 1};
  return p;
}

preset::Object& add(preset::Preset& p, const char* name, preset::Shape::Type type, const char* material, preset::Vec3 scale,
                    preset::Vec3 at)
{
  p.scene.objects.push_back(test::shape_object(name, type, material));
  p.scene.objects.back().transform.scale = scale;
  p.scene.objects.back().transform.translate = at;
  return p.scene.objects.back();
}

struct Seen {
  spectral::Sight sight;
  glm::dvec3 place; ///< of its end, in the preset's coordinates
  std::string first, last;
};

Seen see(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  const spectral::Sight sight = spectral::look_through_pixel(scene, scene::build_bvh(scene.geometry), 0, 0);
  const auto name = [&](int object) { return object < 0 ? "" : scene.objects[static_cast<std::size_t>(object)].name; };
  return {sight, scene.origin + glm::dvec3(sight.last.position), name(sight.first.object), name(sight.last.object)};
}

TEST(Sight, a_pane_displaces_what_is_behind_it)
{
  // Straight down through a pane of thickness t that leans by a: t sin(a - b) / cos b to the side, with sin a = n sin b.
  constexpr double lean = 40 * degree, thickness = 0.5;
  preset::Preset p = one_pixel({0, -1, 0});
  p.scene.camera.up = {0, 0, 1};
  add(p, "pane", preset::Shape::Type::box, "glass", {6, thickness, 6}, {0, -3, 0}).transform.rotate_deg = {0, 0, 40};
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, -8, 0});
  const Seen seen = see(p);
  EXPECT_EQ(seen.first, "pane");
  EXPECT_EQ(seen.last, "wall");
  const double b = std::asin(std::sin(lean) / n);
  EXPECT_NEAR(std::abs(seen.place.x), thickness * std::sin(lean - b) / std::cos(b), 1e-5);
  EXPECT_NEAR(seen.place.y, -8, 1e-5);
  EXPECT_NEAR(seen.place.z, 0, 1e-5);
  EXPECT_NEAR(glm::length(glm::dvec3(seen.sight.way) - glm::dvec3(0, -1, 0)), 0, 1e-6);
  // A pixel is 1 degree wide; the way is 8 long, and a little more.
  EXPECT_NEAR(seen.sight.spacing, 8 * 2 * std::tan(0.5 * degree), 0.01 * seen.sight.spacing);
}

TEST(Sight, total_reflection_is_followed)
{
  // From within a block: 60 degrees onto its side is beyond the critical angle of 41.8, then 30 onto its top, where the look leaves it.
  preset::Preset p = one_pixel({std::cos(60 * degree), std::sin(60 * degree), 0});
  add(p, "block", preset::Shape::Type::box, "glass", {1, 4, 4}, {0, 0, 0});
  add(p, "wall", preset::Shape::Type::quad, "wall", {40, 1, 40}, {0, 5, 0}).transform.rotate_deg = {180, 0, 0};
  const Seen seen = see(p);
  EXPECT_EQ(seen.first, "block");
  EXPECT_EQ(seen.last, "wall");
  // Unfolded, y = 2 is met at x = 2 tan 30; the side, at x = 0.5, sends it back to 1 - 2 tan 30.
  const double out = std::asin(n * std::sin(30 * degree)), unfolded = 2 * std::tan(30 * degree);
  EXPECT_NEAR(seen.place.x, 1 - unfolded - 3 * std::tan(out), 1e-5);
  EXPECT_NEAR(seen.place.y, 5, 1e-5);
}

TEST(Sight, a_mirror_is_followed_and_an_empty_one_shows_itself)
{
  preset::Preset p = one_pixel({1, -1, 0});
  add(p, "mirror", preset::Shape::Type::quad, "mirror", {4, 1, 4}, {1, -1, 0});
  Seen seen = see(p);
  EXPECT_EQ(seen.first, "mirror");
  EXPECT_EQ(seen.last, "mirror");
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 3, 0}).transform.rotate_deg = {180, 0, 0};
  seen = see(p);
  EXPECT_EQ(seen.first, "mirror");
  EXPECT_EQ(seen.last, "wall");
  test::expect_near(seen.place, {5, 3, 0}, 1e-5);
}

TEST(Sight, glass_that_bends_nothing_is_not_seen)
{
  // A box of air, and one of the same glass inside a pane: neither shows, alone or before what does.
  preset::Preset p = one_pixel({0, 0, -1});
  p.scene.materials["air"] = test::glass(1);
  add(p, "nothing", preset::Shape::Type::box, "air", {1, 1, 1}, {0, 0, -2});
  EXPECT_EQ(see(p).sight.first.object, -1);
  add(p, "inner", preset::Shape::Type::box, "glass", {1, 1, 1}, {0, 0, -5});
  add(p, "pane", preset::Shape::Type::box, "glass", {3, 3, 3}, {0, 0, -5});
  Seen seen = see(p);
  EXPECT_EQ(seen.first, "pane");
  EXPECT_EQ(seen.last, "pane");
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 0, -9}).transform.rotate_deg = {90, 0, 0};
  seen = see(p);
  EXPECT_EQ(seen.first, "pane");
  EXPECT_EQ(seen.last, "wall");
}

TEST(Sight, nothing_is_seen_where_nothing_is)
{
  preset::Preset p = one_pixel({0, 0, -1});
  const Seen seen = see(p);
  EXPECT_EQ(seen.sight.first.object, -1);
  EXPECT_EQ(seen.sight.last.object, -1);
}

TEST(Sight, a_ball_bends_about_its_normals)
{
  // A ball of n = 1.5 and radius 1: a look that meets it h off its axis leaves it turned towards the axis by 2 (a - b), sin a = h, sin b =
  // h / n.
  constexpr double h = 0.4;
  preset::Preset p = one_pixel({h, 0, -1});
  p.scene.camera.position = {h, 0, 0};
  add(p, "ball", preset::Shape::Type::sphere, "glass", {2, 2, 2}, {0, 0, -3});
  add(p, "wall", preset::Shape::Type::quad, "wall", {20, 1, 20}, {0, 0, -9}).transform.rotate_deg = {90, 0, 0};
  const Seen seen = see(p);
  EXPECT_EQ(seen.last, "wall");
  const double turn = 2 * (std::asin(h) - std::asin(h / n));
  EXPECT_NEAR(seen.sight.way.x, -std::sin(turn), 1e-6);
  // The way leaves the ball with the same distance h from its centre.
  EXPECT_NEAR(seen.place.x, h / std::cos(turn) - 6 * std::tan(turn), 1e-5);
}

} // namespace nephroid::sight_test
