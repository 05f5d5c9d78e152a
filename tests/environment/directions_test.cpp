// SPDX-License-Identifier: Apache-2.0
// The directions of a bake and the map of a sphere; which baked directions stand for a light, and how their spheres are
// turned.
#include "scene/ray.h"
#include "tests/environment/views.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::directions_test {

using namespace nephroid::environment;

TEST(Directions, AreCornersEdgesAndFaces) {
  std::map<int, int> kinds; // by how many coordinates are 0
  for (const glm::dvec3& d : light_directions(26)) {
    EXPECT_NEAR(glm::length(d), 1, 1e-15);
    const int zeros = static_cast<int>(d.x == 0) + static_cast<int>(d.y == 0) + static_cast<int>(d.z == 0);
    ++kinds[zeros];
    for (int axis = 0; axis < 3; ++axis) // to the middle from a corner, an edge, a face of the cube
      EXPECT_NEAR(std::abs(d[axis]), d[axis] == 0 ? 0 : 1 / std::sqrt(3 - zeros), 1e-15);
  }
  EXPECT_EQ(kinds, (std::map<int, int>{{0, 8}, {1, 12}, {2, 6}}));
}

TEST(Directions, AreAsManyAsTheySayAndEachSetHoldsTheOneBefore) {
  for (const int count : direction_counts()) {
    const std::vector<glm::dvec3> all = light_directions(count);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(count));
    double closest = 2;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) closest = std::min(closest, glm::distance(all[i], all[j]));
    EXPECT_GT(closest, count == 26 ? 0.6 : count == 98 ? 0.25 : 0.1);
    if (count == 26) continue;
    for (const glm::dvec3& before : light_directions(count == 98 ? 26 : 98))
      EXPECT_TRUE(std::ranges::any_of(all, [&](const glm::dvec3& d) { return glm::distance(d, before) < 1e-12; }));
  }
}

TEST(SphereMap, TakesTexelsToDirectionsAndBack) {
  for (const int side : {1, 2, 7, 48, 361}) {
    const SphereMap map{side};
    for (std::size_t t = 0; t < map.texels(); ++t) {
      const glm::dvec3 d = map.direction(t);
      ASSERT_NEAR(glm::length(d), 1, 1e-12);
      if (side % 2 == 0 || t % 3 == 0) { // the middle row and column of an odd map lie on the fold
        ASSERT_TRUE(map.texel(d) == t || side % 2 == 1) << side << " " << t;
      }
    }
  }
  const SphereMap map{4};
  for (const glm::dvec3& pole : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)})
    EXPECT_LT(map.texel(pole), 16u);
}

// Directions that are even on the sphere (Fibonacci's lattice) fill every texel alike, and a texel's middle is near its
// directions.
TEST(SphereMap, HasTexelsOfEqualSolidAngle) {
  const SphereMap map{20};
  constexpr int count = 400 * 1000;
  std::vector<int> filled(map.texels());
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), azimuth = 2.399963229728653 * i;
    const glm::dvec3 d(r * std::cos(azimuth), r * std::sin(azimuth), z);
    const std::size_t texel = map.texel(d);
    ++filled[texel];
    ASSERT_GT(glm::dot(d, map.direction(texel)), std::cos(0.25)); // a texel is 10 degrees wide, and some are slanted
  }
  for (const int n : filled) EXPECT_NEAR(n, 1000, 30);
}

class EnvironmentDirections : public EnvironmentJobs {};

// A flat glass ellipsoid above a floor, under a lamp half way between baked directions. The reference has the lamp's
// direction among 386 that are baked; of 98 four are 11 degrees away, of 26 four are 22.
TEST_F(EnvironmentDirections, ALampBetweenThemIsNearerWhereTheyAreMore) {
  const auto picture = [&](int directions) {
    preset::Preset p = bake_preset(
        R"({"name": "lens", "shape": {"type": "sphere", "radius": 1}, "material": "glass", "transform": {"scale": [1, 0.4, 1]}}, )" +
            facing_quad("floor", {0, -1.2, 0}, {0, 1, 0}, 8),
        {"environment.resolution=32", "environment.spheres=16", "environment.photons=20000", "environment.reach=2",
         "stop.passes=8", "environment.refine=false", "scene.camera.resolution=[48, 48]",
         fmt::format("environment.directions={}", directions)});
    // Of the 386 points of a cube's surface (1, 4, 1) of 4.
    p.scene.lights = {lamp(glm::normalize(glm::dvec3(1, -4, 1)), 3)};
    look(p, {0, 4, 0.1}, {0, -1.2, 0}, 60);
    return layer_rgb(run(p), "caustic");
  };
  const auto distance = [](const std::vector<float>& a, const std::vector<float>& b) {
    double off = 0, length = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      off += std::pow(a[i] - b[i], 2);
      length += std::pow(b[i], 2);
    }
    return std::sqrt(off / length);
  };
  const std::vector<float> reference = picture(386);
  const double of_26 = distance(picture(26), reference), of_98 = distance(picture(98), reference);
  fmt::print("rel_l2 of the caustic layer: 26 directions {:.3f}, 98 directions {:.3f}\n", of_26, of_98);
  EXPECT_LT(of_98, 0.7 * of_26);
}

constexpr int some = 300; ///< directions, even on the sphere

/// The largest element of m m^T - 1, and how far the determinant is from 1.
double off_a_rotation(const glm::dmat3& m) {
  const glm::dmat3 rest = m * glm::transpose(m) - glm::dmat3(1);
  double off = std::abs(glm::determinant(m) - 1);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) off = std::max(off, std::abs(rest[i][k]));
  return off;
}

class NearDirections : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Counts, NearDirections, testing::Values(26, 98, 386));

TEST_P(NearDirections, ABakedDirectionIsNearToItselfAlone) {
  const std::vector<glm::dvec3> baked = light_directions(GetParam());
  for (std::size_t i = 0; i < baked.size(); ++i) {
    // A direction is rounded, so a neighbour may have some 1e-16 as well.
    double own = 0;
    for (const NearDirection& near : near_directions(baked[i], GetParam()))
      if (near.direction == static_cast<int>(i))
        own += near.weight;
      else
        EXPECT_LT(near.weight, 1e-14) << i;
    EXPECT_NEAR(own, 1, 1e-14) << i;
  }
}

// The point where the light comes through the cube is the mean of the corners of its cell, by their weights.
TEST_P(NearDirections, TheirWeightedMeanIsTheDirection) {
  const std::vector<glm::ivec3> points = cube_points(GetParam());
  for (int i = 0; i < some; ++i) {
    const glm::dvec3 travel = scene::even_direction(i, some);
    glm::dvec3 mean(0);
    double sum = 0;
    const std::vector<NearDirection> near = near_directions(3.0 * travel, GetParam());
    ASSERT_LE(near.size(), 4u);
    for (const NearDirection& n : near) {
      ASSERT_GE(n.direction, 0);
      ASSERT_LT(n.direction, GetParam());
      EXPECT_GT(n.weight, 0);
      sum += n.weight;
      mean += n.weight * glm::dvec3(points[static_cast<std::size_t>(n.direction)]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(glm::distance(glm::normalize(mean), -travel), 1e-12) << i;
  }
}

// Across the borders of cells and faces the weights go on without a jump: a step of 1e-6 changes them by a few 1e-6.
TEST_P(NearDirections, WeightsAreContinuous) {
  const auto weights = [&](const glm::dvec3& travel) {
    std::vector<double> all(static_cast<std::size_t>(GetParam()));
    for (const NearDirection& n : near_directions(travel, GetParam()))
      all[static_cast<std::size_t>(n.direction)] += n.weight;
    return all;
  };
  const auto step = [&](const glm::dvec3& at, const glm::dvec3& by) {
    const std::vector<double> a = weights(glm::normalize(at - 5e-7 * by)), b = weights(glm::normalize(at + 5e-7 * by));
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  };
  for (const glm::dvec3& baked : light_directions(GetParam()))
    for (int k = 0; k < 16; ++k) EXPECT_LT(step(baked, scene::even_direction(k, 16)), 2e-5);
  for (int i = 0; i < some; ++i) { // on the cube's edges
    const glm::dvec3 d = scene::even_direction(i, some);
    EXPECT_LT(step(glm::normalize(glm::dvec3(1, std::copysign(1, d.x), d.z)), d), 2e-5);
  }
}

TEST(ShortestTurn, TakesOneToTheOther) {
  for (int i = 0; i < some; ++i) {
    const glm::dvec3 from = scene::even_direction(i, some), to = scene::even_direction((7 * i + 3) % some, some);
    const glm::dmat3 turn = shortest_turn(from, to);
    EXPECT_LT(glm::distance(turn * from, to), 1e-14);
    EXPECT_LT(off_a_rotation(turn), 1e-13);
    // The shortest leaves what is across both where it is.
    const glm::dvec3 across = glm::cross(from, to);
    EXPECT_LT(glm::distance(turn * across, across), 1e-14);
  }
}

// Opposite vectors, equal ones, and those that are so within any small angle.
TEST(ShortestTurn, IsARotationOfNearlyOppositeAndNearlyEqualVectors) {
  for (int i = 0; i < 20; ++i)
    for (const double sign : {-1.0, 1.0})
      for (const double angle : {0.0, 1e-16, 1e-12, 1e-9, 7e-9, 1e-8, 2e-8, 3e-8, 5e-8, 1e-7, 3e-7, 1e-6, 1e-4}) {
        const glm::dvec3 from = scene::even_direction(i, 20);
        const glm::dvec3 across = glm::normalize(glm::cross(from, scene::even_direction((i + 7) % 20, 20)));
        const glm::dvec3 to = glm::normalize(sign * from + angle * across);
        const glm::dmat3 turn = shortest_turn(from, to);
        EXPECT_LT(off_a_rotation(turn), 1e-13) << sign << " " << angle;
        EXPECT_LT(glm::distance(turn * from, to), 1e-7) << sign << " " << angle; // 1 - cos of less is rounded off
      }
}

TEST(TurnedSets, TakeTheLightToItsBakedDirections) {
  const glm::dmat3 rotation = scene::rotation({20, -70, 130});
  for (const int count : {26, 98, 386}) {
    const std::vector<glm::dvec3> baked = light_directions(count);
    for (int i = 0; i < some; ++i) {
      const DistantLight light{scene::even_direction(i, some), {1, 2, 0.5}};
      glm::dvec3 flux(0);
      for (const TurnedSet& set : turned_sets({light}, rotation, count, {1})) {
        EXPECT_LT(glm::distance(set.to_bake * light.direction, baked[static_cast<std::size_t>(set.direction)]), 1e-6);
        EXPECT_LT(off_a_rotation(set.to_bake), 1e-6);
        flux += set.flux;
      }
      EXPECT_LT(glm::distance(flux, light.irradiance), 1e-6);
    }
  }
}

// A light that was baked, on an object that stands as it was baked, is not turned.
TEST(TurnedSets, ABakedLightIsNotTurned) {
  const std::vector<glm::dvec3> baked = light_directions(26);
  for (const glm::dvec3& direction : baked)
    for (const TurnedSet& set : turned_sets({{direction, glm::dvec3(1)}}, glm::dmat3(1), 26, {1})) {
      if (set.flux.x < 1e-6) continue;
      EXPECT_EQ(glm::dvec3(set.flux.x), glm::dvec3(1));
      for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        EXPECT_LT(glm::distance(set.to_bake * axis, axis), 1e-6);
    }
}

// The object turned with its light has the same sets, which only see the scene turned.
TEST(TurnedSets, TheObjectTurnedWithItsLight) {
  const glm::dmat3 turn = scene::rotation({-40, 15, 77}), before = scene::rotation({5, 50, 0});
  for (int i = 0; i < some; ++i) {
    const glm::dvec3 direction = scene::even_direction(i, some);
    const auto a = turned_sets({{direction, glm::dvec3(1)}}, before, 98, {1}),
               b = turned_sets({{turn * direction, glm::dvec3(1)}}, turn * before, 98, {1});
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].direction, b[k].direction);
      EXPECT_NEAR(a[k].flux.x, b[k].flux.x, 1e-6);
      for (int n = 0; n < 10; ++n) {
        const glm::dvec3 d = scene::even_direction(n, 10);
        EXPECT_LT(glm::distance(a[k].to_bake * d, b[k].to_bake * (turn * d)), 1e-6);
      }
    }
  }
}

TEST(TurnedSets, BlackLightsHaveNone) {
  EXPECT_TRUE(turned_sets({{{0, -1, 0}, glm::dvec3(0)}}, glm::dmat3(1), 26, {1}).empty());
  EXPECT_FALSE(turned_sets({{{0, -1, 0}, {0, 0, 1}}}, glm::dmat3(1), 26, {1}).empty());
}

} // namespace nephroid::directions_test
