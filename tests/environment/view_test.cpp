// SPDX-License-Identifier: Apache-2.0
// What engine 2 shows, through a job: a white furnace about a ball, receivers and what hides caustics from them, the
// light of lamps behind a ball lens.
#include "optics/fresnel.h"
#include "scene/ray.h"
#include "tests/environment/views.h"

namespace nephroid::view_test {

using std::numbers::pi;

class EnvironmentView : public EnvironmentJobs {
protected:
  static void go_on(job::Job& job, const preset::Preset& p) { ASSERT_TRUE(job.adopt(p)); }
};

/// Of each of some receivers: its direct light and its caustic, where all light together is 1.
struct Furnace {
  std::vector<double> direct, caustic;
  glm::dvec3 sum{0}; ///< of all receivers, linear sRGB, the mean
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

constexpr int around = 12;           ///< receivers
constexpr double receivers_at = 3.5; ///< radii of the ball

/// What the quad sees of a ball in front of it: sin^2 of the ball's half angle.
constexpr double hidden = 1 / (receivers_at * receivers_at);

preset::Preset furnace_scene(const preset::Overrides& more = {}) {
  std::string quads;
  for (int i = 0; i < around; ++i) {
    const glm::dvec3 way = scene::even_direction(i, around);
    quads += (i ? ", " : "") + facing_quad(fmt::format("receiver {}", i), receivers_at * way, -way,
                                           0.1); // so small that they hardly see each other
  }
  preset::Preset p = ball_and(quads, more);
  even_light(p);
  return p;
}

Furnace furnace(job::Job& job, preset::Preset& p) {
  Furnace made;
  for (int i = 0; i < around; ++i) {
    const glm::dvec3 way = scene::even_direction(i, around);
    look(p, 1.9 * way, receivers_at * way, 2.5);
    EXPECT_TRUE(job.adopt(p));
    while (!job.finished()) job.advance();
    const job::Snapshot shown = job.snapshot();
    made.direct.push_back(mean(layer_rgb(shown, "direct")).y);
    made.caustic.push_back(mean(layer_rgb(shown, "caustic")).y);
    EXPECT_EQ(mean(layer_rgb(shown, "background")), glm::dvec3(0));
    made.sum += mean(shown.picture->rgb) / double(around);
  }
  return made;
}

// Glass that takes nothing changes no radiance, so a receiver gets of the ball as much as it would get of the sky
// behind. Few lights leave gaps between their cones of light, but in the mean over all directions each light's power is
// exact (caustics_test.cpp).
TEST_F(EnvironmentView, AWhiteFurnaceStaysWhite) {
  preset::Preset p = furnace_scene({"scene.camera.resolution=[24, 24]", "environment.refine=false", "leave_out=false"});
  const auto job = job_of(p);
  for (const int lights : {8, 24, 64}) {
    environment::settings(p).lights = lights;
    const Furnace f = furnace(*job, p);
    double squares = 0, most = 0;
    for (const double caustic : f.caustic) {
      squares += std::pow(caustic - hidden, 2) / around;
      most = std::max(most, std::abs(caustic - hidden));
    }
    fmt::print("q = {}: direct {:.4f} (1 - sin^2: {:.4f}), caustic {:.4f} ({:.4f}); a receiver {:.2f} % off, {:.2f} % "
               "at most\n",
               lights, mean_of(f.direct), 1 - hidden, mean_of(f.caustic), hidden, 100 * std::sqrt(squares), 100 * most);
    // 27648 places of the sky, half of them below the receiver; with 4 million the mean is within .0005.
    EXPECT_NEAR(mean_of(f.direct), 1 - hidden, 0.015);
    EXPECT_NEAR(mean_of(f.caustic), hidden, 0.005);
    EXPECT_LT(most, lights == 8 ? 0.1 : 0.03);
  }
}

TEST_F(EnvironmentView, DispersionLeavesAFurnaceNeutral) {
  preset::Preset p =
      furnace_scene({R"(scene.materials.glass.dispersion={"type": "cauchy", "coefficients": [1.45, 0.02]})"});
  const auto job = job_of(p);
  const Furnace f = furnace(*job, p);
  fmt::print("dispersive: direct {:.4f}, caustic {:.4f}; all together {:.4f} {:.4f} {:.4f}\n", mean_of(f.direct),
             mean_of(f.caustic), f.sum.x, f.sum.y, f.sum.z);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(f.sum[c], 1, 0.02) << c;
}

// Seen through glass and in a mirror, even surroundings are as bright as beside them, pixel for pixel.
TEST_F(EnvironmentView, ThroughTheBallTheBackgroundIsAsBright) {
  for (const char* material : {"glass", "mirror"}) {
    preset::Preset p = ball_and("");
    p.scene.objects[0].material = material;
    even_light(p, 3);
    look(p, {0, 1, 4}, {0, 0, 0}, 40);
    const job::Snapshot made = run(p);
    const auto [low, high] = std::ranges::minmax(layer_rgb(made, "background"));
    fmt::print("{}: {:.5f} to {:.5f} of 3\n", material, low, high);
    EXPECT_NEAR(low, 3, 0.003);
    EXPECT_NEAR(high, 3, 0.003);
    EXPECT_EQ(mean(layer_rgb(made, "direct")), glm::dvec3(0)); // there are no receivers
    EXPECT_EQ(mean(layer_rgb(made, "caustic")), glm::dvec3(0));
  }
}

// An even sky lights a floor by 1 - 1 / d^2 of what it does without the ball, d radii below its middle.
TEST_F(EnvironmentView, TheFirstPictureHasTheShadowOfTheBall) {
  for (const double depth : {1.5, 2.0, 3.0}) {
    preset::Preset p = ball_and(facing_quad("floor", {0, -depth, 0}, {0, 1, 0}, 40),
                                {"environment.refine=true", "environment.lights=256"});
    even_light(p);
    look(p, {4, -0.5 * depth, 0}, {0, -depth, 0}, 1);
    const double direct = mean(layer_rgb(job_of(p)->snapshot(), "direct")).y;
    fmt::print("{} radii below the middle: {:.3f}, by its solid angle {:.3f}\n", depth, direct,
               1 - 1 / (depth * depth));
    EXPECT_NEAR(direct, 1 - 1 / (depth * depth), 0.03);
  }
}

// A small screen between the ball and a floor, beside the axis.
TEST_F(EnvironmentView, WhatIsHiddenFromTheObjectHasNoCaustic) {
  preset::Preset p = ball_and(facing_quad("floor", {0, -2.5, 0}, {0, 1, 0}, 8) + ", " +
                              facing_quad("screen", {0.25, -1.75, 0}, {0, 1, 0}, 0.3));
  p.scene.lights = {lamp({0, -1, 0})};
  const auto job = job_of(p);
  const auto caustic = [&](const glm::dvec3& from, const glm::dvec3& at) {
    look(p, from, at, 0.2);
    go_on(*job, p);
    const job::Snapshot made = run(*job);
    return mean(layer_rgb(made, "caustic")).y;
  };
  const double behind_screen = 0.25 / 1.75 * 2.5;
  const double hidden_floor = caustic({3, -1.9, 1.5}, {behind_screen, -2.5, 0}),
               beside = caustic({-3, -1.9, 1.5}, {-behind_screen, -2.5, 0}),
               on_screen = caustic({1.2, -1.4, 0.2}, {0.25, -1.75, 0}),
               under_screen = caustic({0.6, -2.2, 0.3}, {0.25, -1.75, 0}),
               under_floor = caustic({1, -4, 0.3}, {0, -2.5, 0});
  fmt::print("caustic: behind the screen {}, beside it {:.4f}, on it {:.4f}\n", hidden_floor, beside, on_screen);
  EXPECT_EQ(hidden_floor, 0);
  EXPECT_GT(beside, 0.05);
  EXPECT_GT(on_screen, beside);
  EXPECT_EQ(under_screen, 0);
  EXPECT_EQ(under_floor, 0);
}

// A board above the ball, beside its axis or over it: the ball's middle sees the lamp, or not. A second lamp shines
// from the side.
TEST_F(EnvironmentView, ALampThatIsHiddenFromTheObjectThrowsNoCaustic) {
  const auto caustic = [&](double board, const std::vector<preset::Light>& lights) {
    preset::Preset p = ball_and(facing_quad("floor", {0, -2, 0}, {0, 1, 0}, 8) + ", " +
                                facing_quad("board", {board, 3, 0}, {0, 1, 0}, 2));
    p.scene.lights = lights;
    look(p, {3, -1.5, 0}, {0, -2, 0}, 20);
    return mean(layer_rgb(run(p), "caustic")).y;
  };
  const preset::Light above = lamp({0, -1, 0}), side = lamp({1, -1, 0});
  const double free = caustic(1.5, {above}), both = caustic(1.5, {above, side});
  EXPECT_GT(free, 0.01);
  EXPECT_EQ(caustic(0, {above}), 0);
  EXPECT_NEAR(caustic(0, {above, side}), both - free, 0.02 * both);
}

// A board's edge over the ball: a lamp straight above sees (1 + edge) / 2 of its surface. The middle sees the lamp or
// does not.
TEST_F(EnvironmentView, AnEdgeHidesAPartOfALampOrAsInTheThesisAllOfIt) {
  const auto caustic = [&](double edge, const std::string& occlusion) {
    preset::Preset p = ball_and(facing_quad("floor", {0, -2, 0}, {0, 1, 0}, 8) + ", " +
                                    facing_quad("board", {edge + 2, 3, 0}, {0, 1, 0}, 4),
                                {"environment.occlusion=" + occlusion});
    p.scene.lights = {lamp({0, -1, 0})};
    look(p, {3, -1.5, 0}, {0, -2, 0}, 20);
    return mean(layer_rgb(run(p), "caustic")).y;
  };
  const double free = caustic(2, "surface");
  for (const double edge : {-0.4, 0.4}) {
    EXPECT_NEAR(caustic(edge, "surface"), free * (1 + edge) / 2, 0.02 * free) << edge;
    EXPECT_NEAR(caustic(edge, "thesis"), edge > 0 ? free : 0, 1e-6 * free) << edge;
  }
}

/// Of the first lamp, W/m^2 of Y.
double y_of_lamp(const preset::Preset& p) { return environment::lamps(scene::load_scene(p)).at(0).irradiance.y; }

// Where rays at the height h from a ball's axis cross it, h / sin(2 (i - t)), as it follows from Snell's law at both
// surfaces: n / (2 (n - 1)) for h = 0, nearer to the ball for others. The power within a disc about the axis, for light
// of 1 W/m^2.
double power_in_disc(double n, double distance, double disc) {
  constexpr int rings = 2000;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double h = (k + 0.5) / rings, turn = 2 * (std::asin(h) - std::asin(h / n)), cross = h / std::sin(turn);
    if (std::abs(distance - cross) * std::tan(turn) < disc) sum += 2 * pi * h / rings;
  }
  return sum;
}

// Lamps all around, each with a receiver of its own behind the ball, at another distance: that in the focus is the
// brightest.
TEST_F(EnvironmentView, ABallLensHasItsFocusWhereRaysMeet) {
  const std::vector<double> distances{1.25, 1.3, 1.35, 1.4, 1.45, 1.5, 1.55, 1.6, 1.8};
  const int count = static_cast<int>(distances.size());
  std::string quads;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 way = scene::even_direction(i, count);
    quads += (i ? ", " : "") +
             facing_quad(fmt::format("receiver {}", i), distances[static_cast<std::size_t>(i)] * way, -way, 0.1);
  }
  preset::Preset p = ball_and(quads, {"environment.resolution=96", "environment.spheres=20", "environment.reach=1",
                                      "environment.photons=15000", "stop.passes=1"});
  for (int i = 0; i < count; ++i) p.scene.lights.push_back(lamp(scene::even_direction(i, count)));
  const auto job = job_of(p);
  const double y = y_of_lamp(p);
  std::vector<double> found, expected;
  for (int i = 0; i < count; ++i) {
    const double distance = distances[static_cast<std::size_t>(i)];
    const glm::dvec3 way = scene::even_direction(i, count),
                     across = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.5, 0.8)));
    look(p, (distance - 0.15) * way + 0.1 * across, distance * way, 2);
    go_on(*job, p);
    found.push_back(pi * mean(layer_rgb(run(*job), "caustic")).y);
    // A texel and straight lines to its neighbours spread light as a disc does that is two texels across.
    const double disc = distance * std::sqrt(4 * pi) / 96;
    expected.push_back(y * power_in_disc(1.5, distance, disc) / (pi * disc * disc));
    fmt::print("at {}: {:.1f} W/m^2, by rays {:.1f}\n", distance, found.back(), expected.back());
  }
  const auto brightest = [&](const std::vector<double>& of) {
    return distances[static_cast<std::size_t>(std::ranges::max_element(of) - of.begin())];
  };
  EXPECT_NEAR(brightest(found), brightest(expected), 0.051);
  EXPECT_NEAR(brightest(found), 1.5, 0.15 * 1.5); // paraxial
}

// Of light of 1 W/m^2 straight down onto a ball of radius 1: the power on a square of a floor at y = -depth, by Snell's
// and Fresnel's laws. A ray at height h from the axis comes in under the angle i and goes on under t. It leaves
// reflected, or after `ways` ways through the ball, each of which takes it by pi - 2 t further around; the angles of
// its place and of its way are from straight up.
double power_on_floor(double n, double depth, double half) {
  constexpr int rings = 20000, most_ways = 8;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double h = (k + 0.5) / rings, i = std::asin(h), t = std::asin(h / n),
                 reflected = optics::fresnel_reflectance(std::cos(i), 1, n);
    for (int ways = 0; ways <= most_ways; ++ways) {
      const double share = ways == 0 ? reflected : std::pow(1 - reflected, 2) * std::pow(reflected, ways - 1);
      const double place = i + ways * (pi - 2 * t),
                   way = ways == 0 ? 2 * i : pi + 2 * (i - t) + (ways - 1) * (pi - 2 * t);
      if (std::cos(way) > -1e-6) continue;
      const double at = std::abs(std::sin(place) - (depth + std::cos(place)) / std::cos(way) * std::sin(way));
      const double on_square = at < half ? 1 : at < half * std::sqrt(2) ? 1 - 4 / pi * std::acos(half / at) : 0;
      sum += 2 * pi * h / rings * share * on_square;
    }
  }
  return sum;
}

TEST_F(EnvironmentView, AFloorGetsThePowerThatLeavesTheBallTowardsIt) {
  for (const double depth : {1.5, 3.0}) {
    preset::Preset p =
        ball_and(facing_quad("floor", {0, -depth, 0}, {0, 1, 0}, 12),
                 {"environment.resolution=96", "environment.photons=50000", "scene.camera.resolution=[64, 64]"});
    p.scene.lights = {lamp({0, -1, 0}, 2)};
    look(p, {0, -1.1, 0}, {0, -3, 0}, 120);
    const double half =
        (depth - 1.1) * std::tan(pi / 3); // of the square of the floor that is seen, whose pixels are equally large
    const double power = 4 * half * half * pi * mean(layer_rgb(run(p), "caustic")).y,
                 expected = y_of_lamp(p) * power_on_floor(1.5, depth, half);
    fmt::print("floor at {}: {:.4f} W, by rays {:.4f}, of {:.4f} W that meet the ball\n", depth, power, expected,
               y_of_lamp(p) * pi);
    // At 1.5 the floor lies in the focus. There spheres lose 1.8 %, and pixels' places change that by 0.6 %.
    EXPECT_NEAR(power, expected, (depth == 1.5 ? 0.03 : 0.02) * expected);
    EXPECT_GT(expected, 0.2 * y_of_lamp(p) * pi);
  }
}

} // namespace nephroid::view_test
