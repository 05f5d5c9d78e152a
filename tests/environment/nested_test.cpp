// SPDX-License-Identifier: Apache-2.0
// Casters of several objects: which they are, glass in glass against rays in double precision, what their bake and its
// key depend on.
#include "environment/checks.h"
#include "tests/environment/bakes.h"
#include "tests/support/test.h"

namespace nephroid::nested_test {

using namespace environment;

const glm::dvec3 slanted = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));

std::string ball(const std::string& name, double radius, const std::string& material, int priority = 0,
                 const std::string& transform = "{}") {
  return fmt::format(
      R"({{"name": "{}", "shape": {{"type": "sphere", "radius": {}}}, "material": "{}", "priority": {}, "transform": {}}})",
      name, radius, material, priority, transform);
}

/// With a second glass, of the index of water.
preset::Preset with_water(const std::string& objects, preset::Overrides overrides = {}) {
  overrides.insert(overrides.begin(), R"(scene.materials.water={"type": "dielectric", "dispersion": 1.33})");
  return bake_preset(objects, overrides);
}

/// A ball of index `outer` and radius 1, in its middle one of index `inner` and radius `core`: the rays that leave, of
/// one that comes in at height h along +x. At every surface both ways are followed, until less than 1e-5 of the power
/// is left.
std::vector<optics::BallRay> nested_rays(double h, double outer, double inner, double core) {
  struct Way {
    glm::dvec2 at, along;
    double share;
    int medium; ///< 0: outside, 1: the ball, 2: its core
  };
  const std::array<double, 3> n{1, outer, inner};
  std::vector<optics::BallRay> left;
  // At the surface between medium m and m + 1; the normal looks outwards.
  std::vector<Way> ways;
  const auto meet = [&](const Way& way, int m) {
    const glm::dvec2 normal = glm::normalize(way.at);
    const bool enters = way.medium == m;
    const auto from = static_cast<std::size_t>(way.medium), to = static_cast<std::size_t>(enters ? m + 1 : m);
    const glm::dvec2 facing = enters ? -normal : normal; // along the way
    const double cosine = glm::dot(way.along, facing), f = optics::fresnel_reflectance(cosine, n[from], n[to]),
                 ratio = n[from] / n[to];
    ways.push_back({way.at, way.along - 2 * cosine * facing, way.share * f, way.medium});
    if (f == 1) return;
    const double beyond = std::sqrt(1 - ratio * ratio * (1 - cosine * cosine));
    ways.push_back(
        {way.at, ratio * way.along + (beyond - ratio * cosine) * facing, way.share * (1 - f), static_cast<int>(to)});
  };
  meet({{-std::sqrt(1 - h * h), h}, {1, 0}, 1, 0}, 0);
  while (!ways.empty()) {
    const Way way = ways.back();
    ways.pop_back();
    if (way.share < 1e-5) continue;
    if (way.medium == 0) {
      left.push_back({way.at.x, way.at.y, std::atan2(way.along.y, way.along.x), way.share, 0});
      continue;
    }
    const double b = glm::dot(way.at, way.along);
    const auto root = [&](double radius) { return b * b - glm::dot(way.at, way.at) + radius * radius; };
    const auto go = [&](double t) { return Way{way.at + t * way.along, way.along, way.share, way.medium}; };
    // From the ball's surface, not from the core's, the core is in the way.
    if (way.medium == 1 && glm::length(way.at) > (1 + core) / 2 && b < 0 && root(core) > 0)
      meet(go(-b - std::sqrt(root(core))), 1);
    else
      meet(go(-b + std::sqrt(root(way.medium == 1 ? 1 : core))), way.medium - 1);
  }
  return left;
}

// The core of higher priority is what is there. At equal priorities the one that was entered last is, which is the
// same.
TEST(Nested, ACoreOfAnotherGlassIsAsRaysThroughBothHaveIt) {
  for (const auto& [core, radius, index, priority] :
       {std::tuple("water", 0.8, 1.33, 0), std::tuple("air", 0.6, 1.0, 3)}) {
    const preset::Preset p =
        with_water(ball("ball", 1, "glass") + ", " + ball("core", radius, core, priority),
                   {R"(scene.materials.air={"type": "dielectric", "dispersion": 1})", "environment.resolution=24",
                    "environment.spheres=3", "environment.photons=500000"});
    const Bake bake = bake_of(p, {slanted});
    EXPECT_EQ(bake.size, 2);
    EXPECT_NEAR(bake.baked[0].met, std::numbers::pi / 4, 1e-3);
    ASSERT_NEAR(bake.radii[0], 1.001, 1e-6); // not the core's
    for (std::size_t i = 0; i < bake.radii.size(); ++i) {
      const std::vector<double> expected = environment::ball_map(
          bake.map, slanted, bake.radii[i], [&](double h) { return nested_rays(h, 1.5, index, radius); }, 600, 360);
      const double distance = relative_distance(bake, 0, i, [&](std::size_t t) { return expected[t]; });
      EXPECT_LT(distance, 0.02) << core << ", radius " << bake.radii[i];
      fmt::print("{}, radius {:.3f}: {:.2f} % off\n", core, bake.radii[i], 100 * distance);
    }
  }
}

// The rays above know of a core what they should: of the ball's own index it is not there.
TEST(Nested, RaysThroughACoreOfTheSameIndexAreThoseOfTheBall) {
  const environment::SphereMap map{24};
  const std::vector<double> plain = environment::ball_map(map, slanted, 1.4, environment::ball_rays(1.5), 300, 200),
                            cored = environment::ball_map(
                                map, slanted, 1.4, [](double h) { return nested_rays(h, 1.5, 1.5, 0.7); }, 300, 200);
  for (std::size_t t = 0; t < plain.size(); ++t) EXPECT_NEAR(cored[t], plain[t], 1e-4);
}

// A ball in a ball of the same glass, in its middle and elsewhere, is the plain ball, whatever the priorities.
TEST(Nested, ABallInABallOfItsGlassIsAPlainBall) {
  const preset::Overrides overrides{"environment.resolution=24", "environment.spheres=3", "environment.photons=300000"};
  const Bake plain = bake_of(bake_preset(glass_ball, overrides), {slanted});
  for (const auto& [transform, priority] :
       {std::pair("{}", -1), std::pair("{}", 0), std::pair(R"({"translate": [0.3, 0.2, -0.1]})", 1)}) {
    const Bake nested = bake_of(
        bake_preset(glass_ball + ", " + ball("inner", 0.5, "glass", priority, transform), overrides), {slanted});
    EXPECT_EQ(nested.radii, plain.radii);
    EXPECT_NEAR(nested.baked[0].sent, plain.baked[0].sent, 1e-3);
    for (std::size_t i = 0; i < plain.radii.size(); ++i)
      EXPECT_LT(relative_distance(nested, 0, i, [&](std::size_t t) { return plain.at(0, i, t).x; }), 0.03)
          << priority << " " << i;
  }
}

// A box of glass with one of water in it that reaches out of its top: every sphere that encloses both gets what leaves
// them.
TEST(Nested, WaterMayReachOutOfItsGlass) {
  const auto box = [](const std::string& name, const std::string& material, const std::string& size, double y) {
    return fmt::format(
        R"({{"name": "{}", "shape": {{"type": "box", "size": {}}}, "material": "{}", "transform": {{"translate": [0, {}, 0]}}}})",
        name, size, material, y);
  };
  const preset::Preset p = with_water(
      box("glass", "glass", "[2, 2, 2]", 0) + ", " + box("water", "water", "[1.6, 2.5, 1.6]", 0.6),
      {"environment.resolution=16", "environment.spheres=4", "environment.photons=300000", "environment.reach=2"});
  const Caster caster = environment::make_caster(p);
  EXPECT_NEAR(caster.size, 2.85, 1e-5);        // from -1 to 1.85
  EXPECT_NEAR(caster.extent.nearest, 1, 1e-5); // the water's sides are nearer, inside the glass
  EXPECT_TRUE(caster.extent.middle_inside);
  const Bake bake = bake_of(p, {slanted});
  EXPECT_NEAR(power_through(bake, 0, 3).x, bake.baked[0].sent, 1e-3 * bake.baked[0].sent);
}

TEST(Nested, TheNearestSurfaceIsOneThatAirTouches) {
  const auto nearest = [](const std::string& objects) {
    return environment::make_caster(with_water(objects)).extent.nearest;
  };
  const auto at = [](double x) { return fmt::format(R"({{"translate": [{}, 0, 0]}})", x); };
  EXPECT_NEAR(nearest(ball("a", 1, "glass") + ", " + ball("b", 0.5, "water")), 1, 1e-6);
  EXPECT_NEAR(nearest(ball("a", 1, "glass") + ", " + ball("b", 0.5, "mirror")), 1, 1e-6);
  EXPECT_NEAR(nearest(ball("a", 1, "glass", 0, at(-2)) + ", " + ball("b", 1, "glass", 0, at(2))), 1, 1e-6);
  // Two that overlap: where they meet, which a few points tell.
  EXPECT_NEAR(nearest(ball("a", 1, "glass", 0, at(-0.6)) + ", " + ball("b", 1, "glass", 0, at(0.6))), 0.8, 0.05);
}

// All are baked where none are named, and the others are not there where some are.
TEST(Nested, WhichObjects) {
  const std::string objects = ball("red", 1, "wall") + ", " + ball("glass", 1, "glass") + ", " +
                              ball("mirror", 0.5, "mirror", 0, R"({"translate": [3, 0, 0]})") + ", " +
                              ball("water", 0.5, "water");
  const auto chosen = [&](const std::string& names) {
    return environment::make_caster(with_water(objects, {"environment.objects=" + names}));
  };
  EXPECT_THAT(chosen("[]").objects, ElementsAre(1, 2, 3));
  EXPECT_EQ(chosen("[]").size, 4.5);
  EXPECT_EQ(chosen("[]").name, "object 'glass', object 'mirror', object 'water'");
  EXPECT_THAT(chosen(R"(["water", "glass"])").objects, ElementsAre(1, 3));
  EXPECT_EQ(chosen(R"(["water", "glass"])").size, 2);
  EXPECT_EQ(chosen(R"(["mirror"])").scene.objects.size(), 1u);
  const auto refusal = [&](const std::string& names) { return refusal_of([&] { chosen(names); }); };
  EXPECT_THAT(refusal(R"(["glass", "glas"])"),
              AllOf(HasSubstr("#/environment/objects/1"), HasSubstr("'glas' is no object of the scene"),
                    HasSubstr("expected one of glass, mirror, water"), HasSubstr("did you mean 'glass'?")));
  EXPECT_THAT(refusal(R"(["red"])"), HasSubstr("'red' is neither of glass nor a mirror"));
  EXPECT_THAT(refusal(R"([""])"), HasSubstr("'' is no object of the scene"));
  EXPECT_THAT(refusal(R"(["water", "water"])"), HasSubstr("'water' is named twice"));
  EXPECT_THAT(refusal_of([&] { with_water(objects, {"environment.objects=3"}); }),
              HasSubstr("expected a list of at most 100 items"));
}

/// rotate_deg of a rotation.
glm::dvec3 degrees_of(const glm::dmat3& r) {
  const double y = std::asin(-r[0][2]), x = std::atan2(r[1][2], r[2][2]), z = std::atan2(r[0][1], r[0][0]);
  return glm::degrees(glm::dvec3(x, y, z));
}

/// Two boxes and a ball, of which the second is turned against the first, all of them turned and moved together.
preset::Preset together(const glm::dvec3& turn_deg, const glm::dvec3& move, const preset::Overrides& overrides = {}) {
  const glm::dmat3 turn = scene::rotation({turn_deg.x, turn_deg.y, turn_deg.z});
  const auto placed = [&](const glm::dvec3& rotate, const glm::dvec3& at) {
    const glm::dvec3 angles = degrees_of(turn * scene::rotation({rotate.x, rotate.y, rotate.z})), to = turn * at + move;
    return fmt::format(R"({{"rotate_deg": [{}, {}, {}], "translate": [{}, {}, {}]}})", angles.x, angles.y, angles.z,
                       to.x, to.y, to.z);
  };
  const auto box = [&](const char* name, const glm::dvec3& rotate, const glm::dvec3& at) {
    return fmt::format(
        R"({{"name": "{}", "shape": {{"type": "box", "size": [2, 1, 1.5]}}, "material": "glass", "transform": {}}})",
        name, placed(rotate, at));
  };
  preset::Overrides all{"environment.resolution=16", "environment.photons=10000", "environment.spheres=3"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return with_water(box("first", {0, 0, 0}, {0.5, 0, 0}) + ", " + box("second", {10, 20, 30}, {0.1, 2.5, -0.3}) + ", " +
                        ball("third", 0.3, "water", 1, placed({0, 0, 0}, {0.5, 0.1, 0})),
                    all);
}

std::uint64_t key_of(const preset::Preset& p) { return environment::bake_key(p, environment::make_caster(p)); }

TEST(Nested, WhatIsTurnedAndMovedTogetherKeepsItsBake) {
  const preset::Preset p = together({0, 0, 0}, {0, 0, 0});
  const std::uint64_t key = key_of(p);
  const Bake bake = bake_of(p, {slanted});
  for (const glm::dvec3& turn : {glm::dvec3(0, 0, 0), {0, 90, 0}, {10, 20, 30}, {-170, 85, 3.3}, {0, 0, 180}}) {
    const preset::Preset moved = together(turn, {3, -70, 0.1});
    EXPECT_EQ(key_of(moved), key) << turn.x << " " << turn.y << " " << turn.z;
    if (turn.y == 20) {
      EXPECT_EQ(bake_of(moved, {slanted}).texels, bake.texels);
    }
  }
}

TEST(Nested, WhatMovesAgainstTheOthersHasAnotherBake) {
  const std::uint64_t key = key_of(together({10, 20, 30}, {1, 2, 3}));
  for (const char* other :
       {"scene.objects.0.transform.translate.0=1.501", "scene.objects.1.transform.translate.1=5",
        "scene.objects.1.transform.rotate_deg.2=31", "scene.objects.2.transform.translate.2=3.01",
        "scene.objects.2.priority=-1", "scene.objects.2.material=glass", "scene.objects.2.shape.radius=0.31",
        R"(environment.objects=["first", "third"])", R"(environment.objects=["first", "second"])"})
    EXPECT_NE(key_of(together({10, 20, 30}, {1, 2, 3}, {other})), key) << other;
  // Of priorities the order alone matters.
  EXPECT_EQ(key_of(together({10, 20, 30}, {1, 2, 3}, {"scene.objects.2.priority=7"})), key);
  EXPECT_EQ(key_of(together({10, 20, 30}, {1, 2, 3}, {R"(environment.objects=["third", "second", "first"])"})), key);
}

} // namespace nephroid::nested_test
