// SPDX-License-Identifier: Apache-2.0
// The directions of a bake and the map of a sphere.
#include "environment/bake/bake.h"
#include "tests/support/test.h"

namespace nephroid::directions_test {

using namespace nephroid::environment;

TEST(Directions, AreCornersEdgesAndFaces)
{
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

TEST(Directions, AreAsManyAsTheySayAndEachSetHoldsTheOneBefore)
{
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

TEST(SphereMap, TakesTexelsToDirectionsAndBack)
{
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

// Directions that are even on the sphere (Fibonacci's lattice) fill every texel alike, and a texel's middle is near its directions.
TEST(SphereMap, HasTexelsOfEqualSolidAngle)
{
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

} // namespace nephroid::directions_test
