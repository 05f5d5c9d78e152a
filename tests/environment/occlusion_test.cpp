// SPDX-License-Identifier: Apache-2.0
// What reaches the object of each light, on a device: against closed forms of what a ball, a rectangle and a floor
// hide.
#include "environment/occlusion/occlusion.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"

namespace nephroid::occlusion_test {

using namespace nephroid::environment;

/// The glass ball at the origin, and these objects beside it. The middle of all that is not diffuse is the scene's (0,
/// 0, 0), so that the ball's is too where the others are diffuse.
scene::Scene scene_with(const std::string& others) {
  return without_caster(scene::load_scene(test::bake_preset(test::glass_ball + (others.empty() ? "" : ", " + others))),
                        {0});
}

std::string ball(const glm::dvec3& place, double radius, const std::string& material = "wall") {
  return fmt::format(
      R"({{"shape": {{"type": "sphere", "radius": {}}}, "material": "{}", "transform": {{"translate": [{}, {}, {}]}}}})",
      radius, material, place.x, place.y, place.z);
}

/// A rectangle that faces +y before it is turned about the axes.
std::string quad(const glm::dvec3& place, double width, double length, const glm::dvec3& rotate_deg = glm::dvec3(0)) {
  return fmt::format(R"({{"shape": {{"type": "quad", "size": [{}, 1, {}]}}, "material": "wall",
                          "transform": {{"translate": [{}, {}, {}], "rotate_deg": [{}, {}, {}]}}}})",
                     width, length, place.x, place.y, place.z, rotate_deg.x, rotate_deg.y, rotate_deg.z);
}

/// A map as few lights, and what is seen of them.
struct Sky {
  CubeMap cube;
  Segmentation lights;
  Occlusion occlusion;

  explicit Sky(const scene::Environment& map, int q = 24)
      : cube(make_cube_map(map)), lights(segment(cube, {.lights = q})), occlusion(test::bake_context(), lights, cube) {}
  std::vector<glm::dvec3> seen_past(const scene::Scene& surroundings, double rotate_deg = 0,
                                    const glm::dvec3& from = glm::dvec3(0)) {
    tracing::World world = surroundings_world(test::bake_context(), surroundings);
    std::vector<glm::dvec3> flux;
    for (const environment::VisibleLight& light : occlusion.visible_lights(world, rotate_deg, {from}))
      flux.push_back(light.flux);
    return flux;
  }
  std::vector<glm::dvec3> seen_past(const std::string& others, double rotate_deg = 0) {
    return seen_past(scene_with(others), rotate_deg);
  }
};

Sky even_sky() { return Sky(test::uniform_map(256, 128)); }

double sum_y(const std::vector<glm::dvec3>& fluxes) {
  return std::accumulate(fluxes.begin(), fluxes.end(), 0.0,
                         [](double sum, const glm::dvec3& flux) { return sum + flux.y; });
}

std::vector<glm::dvec3> all_flux(const Segmentation& lights) {
  std::vector<glm::dvec3> fluxes;
  for (const Region& light : lights.lights) fluxes.push_back(light.flux);
  return fluxes;
}

double cap_sr(double half_angle) { return 2 * pi * (1 - std::cos(half_angle)); }

/// What a light's texels have in directions that `is_seen` is true of; each texel in parts x parts.
template <class IsSeen>
double flux_seen(const CubeMap& cube, const Region& light, int parts, const IsSeen& is_seen) {
  double sum = 0;
  for (int y = parts * light.rect.y0; y < parts * light.rect.y1; ++y)
    for (int x = parts * light.rect.x0; x < parts * light.rect.x1; ++x)
      if (is_seen(position({light.face, middle(x, parts * cube.size), middle(y, parts * cube.size)})))
        sum += cube.flux_of(cube.texel(light.face, x / parts, y / parts)).y / (parts * parts);
  return sum;
}

TEST(Occlusion, WithoutOtherObjectsEveryLightIsWhole) {
  Sky sky(test::synthetic_maps().front().map);
  EXPECT_EQ(sky.seen_past(""), all_flux(sky.lights));
}

TEST(Occlusion, WhatStandsBeforeNoLightTakesNothing) {
  // Black above 30 degrees, where the ball is.
  Sky sky(test::made_map(256, 128, [](const glm::dvec3& d) {
    return glm::dvec3(d.y > 0.5 ? 0.0 : 1.0, 1 + d.x, 2) * (d.y > 0.5 ? 0.0 : 1.0);
  }));
  EXPECT_EQ(sky.seen_past(ball({0, 5, 0}, 2)), all_flux(sky.lights));
}

// A floor hides the lower half of the faces at the sides. What is left of +x comes from the mean of its upper half.
TEST(Occlusion, AHalfHiddenLightShinesFromWhatIsSeen) {
  Sky sky(test::uniform_map(256, 128), 6);
  tracing::World world = surroundings_world(test::bake_context(), scene_with(quad({0, -0.01, 0}, 1000, 1000)));
  const std::vector<environment::VisibleLight> lights = sky.occlusion.visible_lights(world, 0, {glm::dvec3(0)});
  glm::dvec3 mean(0);
  for (int y = 0; y < sky.cube.size / 2; ++y)
    for (int x = 0; x < sky.cube.size; ++x)
      mean += sky.cube.flux_of(sky.cube.texel(0, x, y)).y *
              glm::normalize(position({0, middle(x, sky.cube.size), middle(y, sky.cube.size)}));
  mean = glm::normalize(mean);
  ASSERT_EQ(lights.size(), 6u);
  EXPECT_GT(mean.y, 0.3);
  EXPECT_LT(glm::distance(lights[0].direction, mean), 0.01);
  EXPECT_EQ(lights[2].direction, sky.lights.lights[2].direction); // from above: whole
  EXPECT_EQ(lights[3].flux, glm::dvec3(0));                       // from below: nothing
}

TEST(Occlusion, AClosedRoomHidesAll) {
  Sky sky(test::synthetic_maps().front().map);
  for (const glm::dvec3& flux : sky.seen_past(ball({0.5, 0, 0}, 4))) EXPECT_EQ(flux, glm::dvec3(0));
}

TEST(Occlusion, ABlackMapHasNoLights) {
  Sky sky(test::uniform_map(64, 32, glm::dvec3(0)));
  EXPECT_TRUE(sky.seen_past(ball({0, 5, 0}, 2)).empty());
}

/// A ball of radius r at distance d hides 2 pi (1 - sqrt(1 - r^2 / d^2)). Whatever it is of.
TEST(Occlusion, ABallHidesItsSolidAngle) {
  Sky sky = even_sky();
  for (const std::string material : {"wall", "mirror"})
    for (const double radius : {0.3, 1.0, 2.0, 2.9}) {
      const glm::dvec3 place = 3.0 * glm::normalize(glm::dvec3(0.3, 0.8, -0.52));
      const scene::Scene scene = scene_with(ball(place, radius, material));
      // A mirror moves the scene's middle.
      const double seen = sum_y(sky.seen_past(scene, 0, -scene.origin));
      EXPECT_NEAR(4 * pi - seen, cap_sr(std::asin(radius / 3)), 0.003) << material << ' ' << radius;
    }
}

// Two balls leave a belt 1.6 degrees wide: a few cells of each light.
TEST(Occlusion, OfABeltBetweenTwoBallsItsSolidAngleIsSeen) {
  Sky sky = even_sky();
  const double height = 2.0002, belt = 4 * pi * std::sin(std::acos(2 / height));
  const double seen = sum_y(sky.seen_past(ball({0, height, 0}, 2) + ", " + ball({0, -height, 0}, 2)));
  EXPECT_NEAR(seen, belt, 0.3 * belt);
}

/// Of a triangle, by van Oosterom and Strackee 1983.
double triangle_sr(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
  return std::abs(2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                 x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y));
}

TEST(Occlusion, ARectangleHidesItsSolidAngle) {
  Sky sky = even_sky();
  for (const auto& [x, y, z] : {std::array{0.0, 1.5, 0.0}, std::array{2.0, 1.5, -1.0}, std::array{0.5, -1.2, 3.0}}) {
    const glm::dvec3 place(x, y, z), across(2, 0, 0), along(0, 0, 1);
    const double expected = triangle_sr(place - across - along, place + across - along, place + across + along) +
                            triangle_sr(place - across - along, place + across + along, place - across + along);
    EXPECT_NEAR(4 * pi - sum_y(sky.seen_past(quad(place, 4, 2))), expected, 0.003) << x;
  }
}

/// Under the horizon nothing is left, above it everything: of a light that it crosses, what its texels have above.
TEST(Occlusion, AHugeFloorHidesTheLowerHalf) {
  for (const test::NamedMap& map : test::synthetic_maps()) {
    Sky sky(map.map);
    const std::vector<glm::dvec3> seen = sky.seen_past(quad({0, -1.5, 0}, 1e6, 1e6));
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Region& light = sky.lights.lights[i];
      const int half = sky.cube.size / 2;
      const bool side = light.face != 2 && light.face != 3, above = light.face == 2 || (side && light.rect.y1 <= half);
      if (above)
        EXPECT_EQ(seen[i], light.flux) << map.name << ' ' << i;
      else if (light.face == 3 || light.rect.y0 >= half)
        EXPECT_EQ(seen[i], glm::dvec3(0)) << map.name << ' ' << i;
      else
        EXPECT_NEAR(seen[i].y / light.flux.y,
                    flux_seen(sky.cube, light, 1, [](const glm::dvec3& d) { return d.y > 0; }) / light.flux.y, 0.005)
            << map.name << ' ' << i;
    }
  }
}

TEST(Occlusion, ASmallBallBeforeTheSunHidesJustThat) {
  const glm::dvec3 sun = test::direction_of(40, 70);
  Sky sky(test::made_map(512, 256, [&](const glm::dvec3& d) {
    return test::sky_with_lamps(d, glm::dvec3(1), glm::dvec3(0.5), {{40, 70, 1, glm::dvec3(3e4)}});
  }));
  const double edge = std::cos(2.5 * pi / 180);
  const std::vector<glm::dvec3> seen = sky.seen_past(ball(8.0 * sun, 8 * std::sin(2.5 * pi / 180)));
  double lost = 0, of_sun = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Region& light = sky.lights.lights[i];
    const double expected =
        flux_seen(sky.cube, light, 4, [&](const glm::dvec3& d) { return glm::dot(glm::normalize(d), sun) < edge; });
    EXPECT_NEAR(seen[i].y / light.flux.y, expected / light.flux.y, 0.01) << i;
    if (expected > 0.999999 * light.flux.y) {
      EXPECT_EQ(seen[i], light.flux) << i;
    }
    lost += light.flux.y - seen[i].y;
    of_sun +=
        flux_seen(sky.cube, light, 1, [&](const glm::dvec3& d) { return glm::dot(glm::normalize(d), sun) > edge; });
  }
  EXPECT_GT(of_sun, 0.7 * sky.lights.total_flux.y);
  EXPECT_GT(lost, 0.99 * of_sun);
}

/// Before an even sky the ball's edge passes over at most 2 sin(radius) step of solid angle on its leading side and as
/// much on the other, so no light changes by more, but for the samples that are a sample's width off.
TEST(Occlusion, AMovingBallChangesEveryLightSmoothly) {
  Sky sky = even_sky();
  const double radius = 20 * pi / 180, step_deg = 0.5;
  std::vector<glm::dvec3> before;
  double largest = 0;
  for (int frame = 0; frame < 240; ++frame) {
    const glm::dvec3 place = 6.0 * test::direction_of(-25 + 0.2 * frame, step_deg * frame / std::cos(0.3));
    const std::vector<glm::dvec3> seen = sky.seen_past(ball(place, 6 * std::sin(radius)));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double sample = sky.lights.lights[i].flux.y / 1024;
      largest = std::max(largest, (std::abs(seen[i].y - before[i].y) - 12 * sample));
    }
    before = seen;
  }
  const double moved = std::hypot(0.2, step_deg / std::cos(0.3)) * pi / 180;
  EXPECT_LT(largest, 2 * std::sin(radius) * moved);
}

/// A wall's edge, level or not, that rises before a sun of three degrees, which has most of the light; each frame by
/// 1/16 of a degree. Of q = 6 lights the sun's is a whole face, where 32 x 32 even cells would hide it in a few steps.
TEST(Occlusion, AnEdgeBeforeTheSunDoesNotPop) {
  double largest_error = 0, largest_excess = 0;
  for (const int q : {6, 24})
    for (const double tilt_deg : {0.0, 25.0}) {
      Sky sky(test::made_map(
                  256, 128,
                  [&](const glm::dvec3& d) {
                    return test::sky_with_lamps(d, glm::dvec3(1), glm::dvec3(0.5), {{10, 5, 1.5, glm::dvec3(2e4)}});
                  }),
              q);
      const double tilt = tilt_deg * pi / 180, total = sky.lights.total_flux.y;
      const glm::dvec3 up(-std::sin(tilt), std::cos(tilt), 0), across(up.y, -up.x, 0), sun = test::direction_of(10, 5);
      double seen_before = 0, truth_before = 0, seen_step = 0, truth_step = 0;
      for (int frame = 0; frame <= 96; ++frame) {
        const double middle = std::atan(glm::dot(sun, up) / -sun.z),
                     height = 5 * std::tan(middle + (frame - 48) / 16.0 * pi / 180);
        const double seen =
            sum_y(sky.seen_past(quad((height - 50) * up - glm::dvec3(0, 0, 5), 100, 100, {90, 0, tilt_deg}))) / total;
        const auto above = [&](const glm::dvec3& d) {
          const glm::dvec3 met = -5 / d.z * d;
          return d.z >= 0 || glm::dot(met, up) > height || glm::dot(met, up) < height - 100 ||
                 std::abs(glm::dot(met, across)) > 50;
        };
        const auto bright = [&](const glm::dvec3& d) {
          return glm::dot(glm::normalize(d), sun) > std::cos(3 * pi / 180);
        };
        double truth = 0; // finely about the sun, where the light is
        for (const Region& light : sky.lights.lights) {
          truth += flux_seen(sky.cube, light, 1, [&](const glm::dvec3& d) { return !bright(d) && above(d); }) / total;
          const CubePoint at = met_point(sun);
          if (at.face != light.face) continue;
          Region near = light;
          const int x = texel_of(at.s, sky.cube.size), y = texel_of(at.t, sky.cube.size);
          near.rect = {std::max(near.rect.x0, x - 8), std::max(near.rect.y0, y - 8), std::min(near.rect.x1, x + 8),
                       std::min(near.rect.y1, y + 8)};
          truth += flux_seen(sky.cube, near, 16, [&](const glm::dvec3& d) { return bright(d) && above(d); }) / total;
        }
        largest_error = std::max(largest_error, std::abs(seen - truth));
        if (frame > 0) seen_step = std::max(seen_step, std::abs(seen - seen_before));
        if (frame > 0) truth_step = std::max(truth_step, std::abs(truth - truth_before));
        seen_before = seen;
        truth_before = truth;
      }
      EXPECT_GT(truth_step, 0.015);
      largest_excess = std::max(largest_excess, seen_step - truth_step);
    }
  RecordProperty("largest_excess", std::to_string(largest_excess));
  RecordProperty("largest_error", std::to_string(largest_error));
  EXPECT_LT(largest_excess, 0.005);
  EXPECT_LT(largest_error, 0.01);
}

/// The map turned to the left by so much, past a ball at rest, is the map at rest past a ball turned to the right.
TEST(Occlusion, ATurnedMapIsATurnedBall) {
  Sky sky(test::synthetic_maps()[3].map);
  for (const double rotate_deg : {37.0, -150.0, 90.0}) {
    const glm::dvec3 place = 4.0 * test::direction_of(30, 20);
    const std::vector<glm::dvec3> a = sky.seen_past(ball(place, 1.5), rotate_deg),
                                  b = sky.seen_past(ball(turned(place, -rotate_deg), 1.5));
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i].y, b[i].y, 4.0 / 1024 * sky.lights.lights[i].flux.y) << rotate_deg << ' ' << i;
  }
}

/// A lamp at -z is at -x after a quarter turn to the left (environment.h).
TEST(Occlusion, TheMapTurnsToTheLeft) {
  Sky sky(test::made_map(256, 128, [](const glm::dvec3& d) { return glm::dvec3(d.z < -0.99 ? 100.0 : 0.0); }));
  EXPECT_LT(sum_y(sky.seen_past(ball({-5, 0, 0}, 2), 90)), 1e-6 * sky.lights.total_flux.y);
  EXPECT_EQ(sky.seen_past(ball({5, 0, 0}, 2), 90), all_flux(sky.lights));
  EXPECT_EQ(sky.seen_past(ball({-5, 0, 0}, 2), 0), all_flux(sky.lights));
}

/// Seen from another place, the ball is elsewhere.
TEST(Occlusion, IsOfThePointThatLooks) {
  Sky sky = even_sky();
  const scene::Scene scene = scene_with(ball({0, 3, 0}, 1));
  EXPECT_NEAR(4 * pi - sum_y(sky.seen_past(scene, 0, {0, 1, 0})), cap_sr(std::asin(0.5)), 0.003);
  EXPECT_NEAR(4 * pi - sum_y(sky.seen_past(scene, 0, {4, 3, 0})), cap_sr(std::asin(0.25)), 0.003);
}

} // namespace nephroid::occlusion_test
