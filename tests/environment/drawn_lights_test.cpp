// SPDX-License-Identifier: Apache-2.0
// The lights that passes draw of a sky: they cover each light's region evenly, and leave out what is hidden.
#include "environment/occlusion/occlusion.h"
#include "environment/occlusion/surroundings.h"
#include "scene/bvh.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"
#include "tests/support/test.h"

namespace nephroid::drawn_lights_test {

using namespace nephroid::environment;

/// A map as few lights, and the mean of what passes draw of them.
struct Sky {
  CubeMap cube;
  Segmentation lights;
  Occlusion occlusion;

  Sky(const scene::Environment& map, int q)
      : cube(make_cube_map(map)), lights(segment(cube, {.lights = q})), occlusion(test::bake_context(), lights, cube)
  {
  }

  /// of(light): a sum over lights, in the mean over passes 1..passes.
  template <class Of>
  double mean(std::uint32_t passes, const Of& of) const
  {
    double sum = 0;
    for (std::uint32_t pass = 1; pass <= passes; ++pass)
      for (const VisibleLight& light : occlusion.drawn_lights(pass)) sum += of(light);
    return sum / passes;
  }
};

/// Over the part of an even sky about each of twelve axes that lies within some 8 degrees, about as narrow as what a ball lens throws:
/// ((1 + cos) / 2)^100, whose integral over the sphere is 4 pi / 101. Root mean square, as a part of it.
double off_in_lobes(const Sky& sky, std::uint32_t passes)
{
  double squares = 0;
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 axis = scene::even_direction(i, 12);
    const double mean = sky.mean(
        passes, [&](const VisibleLight& light) { return light.flux.y * std::pow((1 + glm::dot(light.direction, axis)) / 2, 100); });
    squares += std::pow(mean * 101 / (4 * pi) - 1, 2) / 12;
  }
  return std::sqrt(squares);
}

// The lobe's variance is 50 times its mean squared, so points by chance would be 20 % off at q = 8 after 150 passes, 10 % after 600, and 12
// % at q = 24 after 150.
TEST(DrawnLights, CoverTheSkyEvenly)
{
  const Sky few(test::uniform_map(64, 32), 8), many(test::uniform_map(64, 32), 24);
  const double first = off_in_lobes(few, 150), later = off_in_lobes(few, 600), more = off_in_lobes(many, 150);
  fmt::print("q = 8: {:.2f} % off after 150 passes, {:.2f} % after 600; q = 24: {:.2f} % after 150\n", 100 * first, 100 * later,
             100 * more);
  EXPECT_LT(first, 0.08);
  EXPECT_LT(later, 0.025);
  EXPECT_LT(more, 0.035);
}

TEST(DrawnLights, HaveTheColourOfTheirRegions)
{
  const Sky sky(test::synthetic_maps(64)[3].map, 24);
  glm::dvec3 all(0);
  for (const Region& light : sky.lights.lights) all += light.flux;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sky.mean(512, [&](const VisibleLight& light) { return light.flux[c]; }) / all[c], 1, 0.002) << c;
}

/// A sky with balls of radius 2 about the object, at these heights: what is seen of its lights, summed.
double seen_between(Sky& sky, const std::vector<double>& heights)
{
  std::string balls;
  for (const double y : heights)
    balls +=
        fmt::format(R"(, {{"shape": {{"type": "sphere", "radius": 2}}, "material": "wall", "transform": {{"translate": [0, {}, 0]}}}})", y);
  const scene::Scene scene = without_caster(scene::load_scene(test::bake_preset(test::glass_ball + balls)), {0});
  tracing::World world = surroundings_world(test::bake_context(), scene);
  double seen = 0;
  for (const VisibleLight& light : sky.occlusion.visible_lights(world, 0, {glm::dvec3(0)})) seen += light.flux.y;
  return seen;
}

// Of a sky with a ball before it, what drawn cells have is what is seen of the lights; none has light that comes from behind the ball.
TEST(DrawnLights, LeaveOutWhatIsHidden)
{
  Sky sky(test::uniform_map(64, 32), 24);
  const double seen = seen_between(sky, {4});
  const double hidden = 2 * pi * (1 - std::sqrt(0.75)); // the ball is 60 degrees wide
  EXPECT_NEAR(seen, 4 * pi - hidden, 0.002 * 4 * pi);
  EXPECT_NEAR(sky.mean(1024, [](const VisibleLight& light) { return light.flux.y; }), seen, 0.002 * 4 * pi);
  EXPECT_EQ(sky.mean(64, [](const VisibleLight& light) { return light.direction.y > std::cos(0.51) ? light.flux.y : 0; }), 0);
}

// Two balls leave a belt 1.6 degrees wide: a few cells of a light. Many are drawn before one of those is.
TEST(DrawnLights, FindTheFewThatAreSeen)
{
  Sky sky(test::uniform_map(64, 32), 24);
  const double height = 2.0002;
  const double seen = seen_between(sky, {height, -height}), half_belt = std::acos(2 / height);
  EXPECT_NEAR(seen, 4 * pi * std::sin(half_belt), 0.3 * seen);
  EXPECT_NEAR(sky.mean(64, [](const VisibleLight& light) { return light.flux.y; }), seen, 1e-6 * seen);
  EXPECT_EQ(
      sky.mean(64, [&](const VisibleLight& light) { return std::abs(light.direction.y) > 1.001 * std::sin(half_belt) ? light.flux.y : 0; }),
      0);
}

} // namespace nephroid::drawn_lights_test
