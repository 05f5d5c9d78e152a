// SPDX-License-Identifier: Apache-2.0
// The object is one closed solid, whatever its facets are.
#include "inverse/bending.h"
#include "inverse/facets/solid.h"
#include "tests/inverse/sound.h"

namespace nephroid::solid_test {

using namespace inverse;

TEST(Solid, IsClosedWithAnySlopes)
{
  for (int seed = 0; seed < 12; ++seed) {
    const Layout layout = small(23, 17);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.7, seed)));
  }
}

// Equal heights at a corner, equal edges, and two high facets across from two low ones.
TEST(Solid, IsClosedWhereHeightsTie)
{
  const Layout layout = small(8, 8);
  std::mt19937_64 random(3);
  for (int round = 0; round < 40; ++round) {
    std::vector<glm::dvec2> slopes(layout.facet_count());
    for (glm::dvec2& s : slopes) s = 0.2 * glm::dvec2(static_cast<int>(random() % 3) - 1, static_cast<int>(random() % 3) - 1);
    expect_sound(layout, make_solid(layout, slopes));
  }
}

TEST(Solid, IsClosedWhereHeightsNearlyTie)
{
  const Layout layout = small(12, 12);
  for (int seed = 0; seed < 8; ++seed) {
    std::vector<glm::dvec2> slopes = random_slopes(layout, 1e-7 * std::pow(10, seed), seed);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += 0.1 * glm::dvec2(i % 2, i % 3);
    expect_sound(layout, make_solid(layout, slopes));
  }
}

TEST(Solid, OfOneFacetOrOneRow)
{
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2)}) {
    const Layout layout = small(facets.x, facets.y);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.3, 1)));
  }
}

TEST(Solid, FacetsHaveTheirNormals)
{
  const Layout layout = small(9, 7);
  const std::vector<glm::dvec2> slopes = random_slopes(layout, 0.6, 5);
  const Solid solid = make_solid(layout, slopes);
  ASSERT_EQ(solid.parts.size(), solid.mesh.triangles.size());
  std::size_t facets = 0;
  for (std::size_t t = 0; t < solid.parts.size(); ++t) {
    const glm::uvec3 corners = solid.mesh.triangles[t];
    const glm::dvec3 a = solid.mesh.positions[corners.x], b = solid.mesh.positions[corners.y], c = solid.mesh.positions[corners.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    const Part part = solid.parts[t];
    if (part == Part::front) {
      EXPECT_GT(cross.z, 0.9999 * glm::length(cross));
    } else if (part != Part::facet) {
      EXPECT_LT(std::abs(cross.z), 1e-5 * glm::length(cross));
    }
    if (part != Part::facet) continue;
    ++facets;
    const glm::dvec2 cell = (glm::dvec2(middle.x, -middle.y) + layout.size / 2.0) / layout.facet();
    const std::size_t facet = static_cast<std::size_t>(cell.y) * 9 + static_cast<std::size_t>(cell.x);
    const glm::dvec3 normal = *inverse::facet_normal({0, 0, -1}, inverse::direction_of(slopes[facet]), layout.n);
    EXPECT_GT(glm::dot(glm::normalize(cross), normal), 1 - 1e-6) << t;
  }
  EXPECT_GE(facets, 4u * 63);
}

} // namespace nephroid::solid_test
