// SPDX-License-Identifier: Apache-2.0
// The judge against closed forms: a flat slab, a single facet's spot, a wall's shadow, sums of light.
#include "inverse/bending.h"
#include "inverse/judge.h"
#include "optics/fresnel.h"
#include "scene/bvh.h"
#include "tests/support/test.h"

namespace nephroid::judge_test {

using namespace inverse;

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void expect_all_light(const Fates& f) { EXPECT_NEAR(f.sent + f.reflected + f.lost, 1, 1e-10); }

// Light goes straight through a slab: both sides let 1 - ((n - 1) / (n + 1))^2 = 0.96 through, and every cell gets the same.
TEST(Judge, SeesASlabAsAWindow)
{
  Layout layout;
  layout.facets = {16, 16};
  layout.cells = {8, 8};
  layout.distances = {50, 500};
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(256));
  Judge judge(layout, solid, 1);
  while (!judge.finished()) judge.advance();
  EXPECT_NEAR(judge.fates().sent, 0.96 * 0.96, 1e-9);
  EXPECT_EQ(judge.fates().by_walls, 0);
  expect_all_light(judge.fates());
  for (const std::size_t receiver : {0u, 1u})
    for (const double cell : judge.light(receiver)) EXPECT_NEAR(cell, 0.96 * 0.96 * 4, 1e-9); // 4 facets a cell
}

TEST(Judge, FindsAFacetsSpotToAHundredthOfAMillimetre)
{
  Layout layout;
  layout.size = {2, 2};
  layout.facets = {1, 1};
  layout.distances = {100};
  for (const double n : {1.33, 1.5, 2.4})
    for (const glm::dvec2& slope : {glm::dvec2(0.3, 0), glm::dvec2(-0.2, 0.4), glm::dvec2(0, 0)}) {
      layout.n = n;
      const Solid solid = make_solid(layout, {slope});
      const glm::dvec2 at{0.3, -0.4};
      const WayOut way = follow(solid, scene::build_bvh(solid.mesh), n, {at, 20}, {0, 0, -1});
      const double z = glm::dot(inverse::facet_gradient(slope, n), at);
      const glm::dvec2 spot = glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (100 + way.from.z);
      EXPECT_NEAR(glm::length(spot - (at + slope * (100 + z))), 0, 0.01);
      const double front = 1 - std::pow((n - 1) / (n + 1), 2);
      EXPECT_NEAR(way.part, front * inverse::transmitted(slope, n), 1e-6);
    }
}

// A beam of slope s is at s d on a screen at d, a receiver or not.
TEST(Judge, LooksBetweenReceiversToo)
{
  Layout layout;
  layout.size = {1, 1};
  layout.facets = {1, 1};
  layout.receiver = {80, 80};
  layout.cells = {80, 80};
  layout.distances = {100, 200};
  layout.frames = {130, 170};
  const glm::dvec2 slope{0.15, 0.1};
  const Solid solid = make_solid(layout, {slope});
  Judge judge(layout, solid, 1);
  while (!judge.finished()) judge.advance();
  for (const std::size_t i : {0u, 1u}) {
    glm::dvec2 mean(0);
    for (std::size_t c = 0; c < 6400; ++c)
      mean += judge.frame(i)[c] * glm::dvec2(static_cast<double>(c % 80) - 39.5, 39.5 - static_cast<double>(c / 80));
    EXPECT_NEAR(glm::length(mean / total(judge.frame(i)) - slope * layout.frames[i]), 0, 0.1);
  }
  EXPECT_EQ(judge.costs({inverse::Target(6400, 1 / 6400.0), inverse::Target(6400, 1 / 6400.0)}).size(), 2u);
}

// Two facets, 1 mm wide; ga and gb are how steeply they fall towards the line between them, the right one more so. The left one sends light
// to the right by a slope of a. A ray that leaves it at u before the line is at -ga (1/2 - u) - u / a when it gets there, and meets the
// wall if that is above the right one's edge, -gb / 2: where u < (gb - ga) / 2 / (1 / a - ga).
TEST(Judge, MeetsAWallWhereItsShadowIs)
{
  Layout layout;
  layout.size = {2, 1};
  layout.facets = {2, 1};
  layout.distances = {100};
  const double a = 0.05, b = 0.3;
  const Solid solid = make_solid(layout, {{a, 0}, {-b, 0}});
  const double ga = std::abs(inverse::facet_gradient({a, 0}, 1.5).x), gb = std::abs(inverse::facet_gradient({b, 0}, 1.5).x);
  const double shadow = (gb - ga) / 2 / (1 / a - ga);
  const scene::Bvh bvh = scene::build_bvh(solid.mesh);
  for (const double u : {0.02 * shadow, 0.5 * shadow, 0.98 * shadow}) {
    EXPECT_TRUE(follow(solid, bvh, 1.5, {-u, 0.1, 20}, {0, 0, -1}).met_wall) << u / shadow;
  }
  for (const double u : {1.02 * shadow, 2 * shadow, 0.9})
    EXPECT_FALSE(follow(solid, bvh, 1.5, {-u, 0.1, 20}, {0, 0, -1}).met_wall) << u / shadow;
}

TEST(Judge, AccountsForAllLight)
{
  Layout layout;
  layout.facets = {12, 9};
  layout.cells = {20, 10};
  layout.receiver = {300, 200};
  layout.distances = {70};
  layout.sun_radius = 0.05;
  layout.scatter = 0.02;
  std::vector<glm::dvec2> slopes;
  for (int i = 0; i < 108; ++i) slopes.push_back(0.9 * glm::dvec2(std::sin(3 * i), std::cos(5 * i)));
  const Solid solid = make_solid(layout, slopes);
  Judge judge(layout, solid, 1);
  while (!judge.finished()) judge.advance();
  const Fates f = judge.fates();
  expect_all_light(f);
  EXPECT_GT(f.by_walls, 0.001);
  EXPECT_GT(f.lost, 0); // some walls throw light sideways
  EXPECT_LE(total(judge.light(0)) / 108, f.sent + 1e-12);
  EXPECT_GT(total(judge.light(0)) / 108, 0.8 * f.sent);
}

// The blur that the optimiser reckons with is the one that rays have.
TEST(Judge, BlursAsTheFootprintDoes)
{
  Layout layout;
  layout.facets = {1, 1};
  layout.size = {1, 1};
  layout.receiver = {20, 20};
  layout.cells = {40, 40};
  layout.distances = {100};
  layout.sun_radius = std::tan(0.265 * 3.141592653589793 / 180) * 3;
  layout.scatter = 0.01;
  const Solid solid = make_solid(layout, {{0, 0}});
  Judge judge(layout, solid, 1);
  while (!judge.finished()) judge.advance();
  double variance = 0;
  for (std::size_t c = 0; c < 1600; ++c) variance += judge.light(0)[c] * std::pow((static_cast<double>(c % 40) - 19.5) * 0.5, 2);
  variance /= total(judge.light(0));
  // The facet's box, a cell's (which the sum above takes for a point), the sun's disc, and roughness.
  const double sun = layout.sun_radius * 100;
  EXPECT_NEAR(variance, 1 / 12.0 + 0.25 / 12 + sun * sun / 4 + 1, 0.1);
}

} // namespace nephroid::judge_test
