// SPDX-License-Identifier: Apache-2.0
// The judge against closed forms: a flat slab, a single facet's spot, a wall's shadow, sums of light; how a
// facet bends light, and its footprint.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/judge.h"
#include "optics/fresnel.h"
#include "tests/inverse/host_judge.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::judge_test {

using namespace inverse;
using inverse::Layout;

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void expect_all_light(const RayOutcomes& f) { EXPECT_NEAR(f.sent + f.reflected + f.lost, 1, 1e-6); }

// Light goes straight through a slab: both sides let 1 - ((n - 1) / (n + 1))^2 = 0.96 through, and every cell gets the
// same.
TEST(Judge, SeesASlabAsAWindow) {
  Layout layout{.facets = {16, 16}, .cells = {8, 8}, .distances = {50, 500}};
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(256));
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  EXPECT_NEAR(judge.outcomes().sent, 0.96 * 0.96, 1e-6);
  EXPECT_EQ(judge.outcomes().by_walls, 0);
  expect_all_light(judge.outcomes());
  for (const std::size_t receiver : {0u, 1u})
    for (const double cell : judge.light(receiver))
      EXPECT_NEAR(cell, 0.96 * 0.96 * 4, 1e-3); // 4 facets a cell; a ray at an edge may take the next one
}

TEST(Judge, FindsAFacetsSpotToAHundredthOfAMillimetre) {
  Layout layout{.size = {2, 2}, .facets = {1, 1}, .distances = {100}};
  for (const double n : {1.33, 1.5, 2.4})
    for (const glm::dvec2& slope : {glm::dvec2(0.3, 0), glm::dvec2(-0.2, 0.4), glm::dvec2(0, 0)}) {
      layout.n = n;
      const Solid solid = make_solid(layout, {slope});
      const glm::dvec2 at{0.3, -0.4};
      const WayOut way = follow(test::shared_context(), solid, n, {{{at, 20}, {0, 0, -1}}}).front();
      const double z = glm::dot(inverse::facet_gradient(slope, n), at);
      const glm::dvec2 spot = glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (100 + way.from.z);
      EXPECT_NEAR(glm::length(spot - (at + slope * (100 + z))), 0, 0.01);
      const double front = 1 - std::pow((n - 1) / (n + 1), 2);
      EXPECT_NEAR(way.part, front * inverse::transmitted(slope, n), 1e-6);
    }
}

// A beam of slope s is at s d on a screen at d, a receiver or not. Screens between two receivers stand on the line
// between these.
TEST(Judge, LooksBetweenReceiversToo) {
  Layout layout{.size = {1, 1},
                .facets = {1, 1},
                .receiver = {80, 80},
                .cells = {80, 80},
                .distances = {100, 200},
                .frames = {400.0 / 3, 500.0 / 3}};
  layout.offsets = {{{-10, 5}, {20, 15}}};
  const glm::dvec2 slope{0.15, 0.1};
  const Solid solid = make_solid(layout, {slope});
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  for (const std::size_t i : {0u, 1u}) {
    glm::dvec2 mean(0);
    for (std::size_t c = 0; c < 6400; ++c)
      mean += judge.light(layout.distances.size() + i)[c] *
              glm::dvec2(static_cast<double>(c % 80) - 39.5, 39.5 - static_cast<double>(c / 80));
    EXPECT_NEAR(glm::length(mean / total(judge.light(layout.distances.size() + i)) -
                            (slope * layout.frames[i] -
                             glm::mix(layout.offset(0), layout.offset(1), layout.frames[i] / 100 - 1))),
                0, 0.1);
  }
  EXPECT_EQ(judge.costs({inverse::Target(6400, 1 / 6400.0), inverse::Target(6400, 1 / 6400.0)}).size(), 2u);
}

// Two facets, 1 mm wide; ga and gb are how steeply they fall towards the line between them, the right one more so. The
// left one sends light to the right by a slope of a. A ray that leaves it at u before the line is at -ga (1/2 - u) - u
// / a when it gets there, and meets the wall if that is above the right one's edge, -gb / 2: where u < (gb - ga) / 2 /
// (1 / a - ga).
TEST(Judge, MeetsAWallWhereItsShadowIs) {
  Layout layout{.size = {2, 1}, .facets = {2, 1}, .distances = {100}};
  const double a = 0.05, b = 0.3;
  const Solid solid = make_solid(layout, {{a, 0}, {-b, 0}});
  const double ga = std::abs(inverse::facet_gradient({a, 0}, 1.5).x),
               gb = std::abs(inverse::facet_gradient({b, 0}, 1.5).x);
  const double shadow = (gb - ga) / 2 / (1 / a - ga);
  for (const double u : {0.02 * shadow, 0.5 * shadow, 0.98 * shadow, 1.02 * shadow, 2 * shadow, 0.9})
    EXPECT_EQ(follow(test::shared_context(), solid, 1.5, {{{-u, 0.1, 20}, {0, 0, -1}}}).front().met_wall, u < shadow)
        << u / shadow;
}

// Single precision against double, ray by ray, through facets, their walls and total reflections. A ray that comes
// closer to an edge than rounding may take another way.
TEST(Judge, FollowsRaysAsTheHostDoes) {
  Layout layout{.facets = {20, 15}, .distances = {300}};
  std::vector<glm::dvec2> slopes;
  for (int i = 0; i < 300; ++i) slopes.push_back(0.6 * glm::dvec2(std::sin(3 * i), std::cos(5 * i)));
  const Solid solid = make_solid(layout, slopes);
  std::vector<Ray> rays;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 4000; ++i)
    rays.push_back({{49 * uniform(random), 49 * uniform(random), 11},
                    glm::normalize(glm::dvec3(0.1 * uniform(random), 0.1 * uniform(random), -1))});
  const std::vector<WayOut> ways = follow(test::shared_context(), solid, 1.5, rays);
  const scene::Bvh bvh = scene::build_bvh(solid.mesh);
  int others = 0, walls = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const WayOut truth = test::follow_on_host(solid, bvh, 1.5, rays[i].from, rays[i].direction);
    walls += truth.met_wall;
    if (ways[i].met_wall != truth.met_wall || std::abs(ways[i].part - truth.part) > 1e-4) {
      ++others;
      continue;
    }
    EXPECT_NEAR(ways[i].reflected, truth.reflected, 1e-4);
    if (truth.part == 0) continue;
    const auto spot = [](const WayOut& w) {
      return glm::dvec2(w.from) - glm::dvec2(w.direction) / w.direction.z * (300 + w.from.z);
    };
    EXPECT_LT(glm::length(spot(ways[i]) - spot(truth)), 0.01 * std::max(1.0, glm::length(spot(truth)) / 300));
  }
  EXPECT_GT(walls, 20);
  EXPECT_LT(others, 16);
}

TEST(Judge, AccountsForAllLight) {
  Layout layout{.facets = {12, 9},
                .receiver = {300, 200},
                .cells = {20, 10},
                .distances = {70},
                .sun_radius = 0.05,
                .scatter = 0.02};
  std::vector<glm::dvec2> slopes;
  for (int i = 0; i < 108; ++i) slopes.push_back(0.9 * glm::dvec2(std::sin(3 * i), std::cos(5 * i)));
  const Solid solid = make_solid(layout, slopes);
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  const RayOutcomes f = judge.outcomes();
  expect_all_light(f);
  EXPECT_GT(f.by_walls, 0.001);
  EXPECT_GT(f.lost, 0); // some walls throw light sideways
  EXPECT_LE(total(judge.light(0)) / 108, f.sent + 1e-6);
  EXPECT_GT(total(judge.light(0)) / 108, 0.8 * f.sent);
}

// The blur that the optimiser reckons with is the one that rays have.
TEST(Judge, BlursAsTheFootprintDoes) {
  Layout layout{.size = {1, 1},
                .facets = {1, 1},
                .receiver = {20, 20},
                .cells = {40, 40},
                .distances = {100},
                .sun_radius = std::tan(0.265 * 3.141592653589793 / 180) * 3,
                .scatter = 0.01};
  const Solid solid = make_solid(layout, {{0, 0}});
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  double variance = 0;
  for (std::size_t c = 0; c < 1600; ++c)
    variance += judge.light(0)[c] * std::pow((static_cast<double>(c % 40) - 19.5) * 0.5, 2);
  variance /= total(judge.light(0));
  // The facet's box, a cell's (which the sum above takes for a point), the sun's disc, and roughness.
  const double sun = layout.sun_radius * 100;
  EXPECT_NEAR(variance, 1 / 12.0 + 0.25 / 12 + sun * sun / 4 + 1, 0.1);
}

// The vector form of a facet's normal against the thesis' quadratic, Snell's law and the limit of what a facet can
// bend.

glm::dvec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// (5.6) in the plane of both directions, with R = (1, 0) and M = -in: a quadratic of the tangent of the normal's angle.
// Its roots are the two normals that (5.5), Snell's law squared, allows; ours must be one of them.
TEST(Bending, TheVectorFormSolvesTheThesisQuadratic) {
  std::mt19937_64 random(1);
  int solved = 0;
  for (int i = 0; i < 2000; ++i) {
    const double n = std::uniform_real_distribution<double>(1.1, 2.5)(random);
    const glm::dvec3 in = random_direction(random), out = random_direction(random);
    const auto normal = inverse::facet_normal(in, out, n);
    if (!normal) continue;
    ++solved;
    const double mx = -glm::dot(in, out), my = std::sqrt(1 - mx * mx), eta2 = n * n;
    const double a1 = (eta2 * mx * mx - 1) / (eta2 - 1), a2 = 2 * eta2 * mx * my / (eta2 - 1),
                 a3 = eta2 * my * my / (eta2 - 1);
    const glm::dvec3 across = glm::normalize(-in - mx * out); // M's part across R: the second axis
    const double x = glm::dot(*normal, out), y = glm::dot(*normal, across);
    EXPECT_NEAR(a1 * x * x + a2 * x * y + a3 * y * y, 1, 1e-9);                         // (5.5)
    EXPECT_NEAR((2 * a3 - 2) * y * y + 2 * a2 * x * y + (2 * a1 - 2) * x * x, 0, 1e-9); // (5.6) times cos^2
  }
  EXPECT_GT(solved, 200);
}

// The quadratic is 0 = 0 for light that goes straight on; the vector form is not.
TEST(Bending, UndeviatedLightHasAFlatFacet) {
  const glm::dvec3 down{0, 0, -1};
  for (const double n : {1.0001, 1.5, 0.7})
    EXPECT_NEAR(glm::length(*inverse::facet_normal(down, down, n) - down), 0, 1e-12) << n;
}

TEST(Bending, AFacetsNormalRefractsToItsSlope) {
  for (const double n : {0.7, 1.33, 1.5, 2.4})
    for (const double part : {0.01, 0.5, 0.99}) {
      const glm::dvec2 slope = part * inverse::slope_limit(n) * glm::dvec2(0.6, -0.8);
      const glm::dvec3 normal = *inverse::facet_normal({0, 0, -1}, inverse::direction_of(slope), n);
      const glm::dvec3 refracted = glm::refract(glm::dvec3(0, 0, -1), -normal, n); // GLSL's own
      EXPECT_NEAR(glm::length(refracted - inverse::direction_of(slope)), 0, 1e-9) << n << " " << part;
      // The gradient lies in the facet: (1, 0, dz/dx) is across the normal.
      const glm::dvec2 g = inverse::facet_gradient(slope, n);
      EXPECT_NEAR(glm::dot(normal, glm::dvec3(1, 0, g.x)), 0, 1e-12);
      EXPECT_NEAR(glm::dot(normal, glm::dvec3(0, 1, g.y)), 0, 1e-12);
    }
}

// n = 1.5: cos delta = 2 / 3, tan delta = sqrt(5) / 2.
TEST(Bending, SlopesEndWhereLightRunsAlongTheFacet) {
  EXPECT_NEAR(inverse::slope_limit(1.5), std::sqrt(5.0) / 2, 1e-12);
  for (const double n : {0.7, 1.5, 2.4}) {
    const glm::dvec2 limit{inverse::slope_limit(n), 0};
    EXPECT_TRUE(inverse::facet_normal({0, 0, -1}, inverse::direction_of(0.999 * limit), n)) << n;
    EXPECT_FALSE(inverse::facet_normal({0, 0, -1}, inverse::direction_of(1.001 * limit), n)) << n;
    EXPECT_LT(inverse::transmitted(0.9999 * limit, n), 0.2) << n;
  }
  EXPECT_NEAR(inverse::transmitted({0, 0}, 1.5), 0.96, 1e-12); // ((n - 1) / (n + 1))^2 is reflected
}

// A facet's footprint against points drawn on it.

Layout coarse() {
  return {.facets = {8, 6}, .distances = {60, 130}}; // a facet of 12.5 x 16.7 mm over cells of 1.56 mm
}

std::vector<double> sums(const std::vector<double>& cells, int columns, bool along_x) {
  std::vector<double> all(static_cast<std::size_t>(columns));
  for (std::size_t c = 0; c < cells.size(); ++c)
    all[along_x ? c % static_cast<std::size_t>(columns) : c / static_cast<std::size_t>(columns)] += cells[c];
  return all;
}

/// Points of the facet, each sent on its way from its own height; blurred as the sun's disc and a rough surface do.
std::vector<double> drawn(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
                          int count, double height = 0) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const glm::dvec2 g = inverse::facet_gradient(slope, layout.n);
  const glm::dmat2 widens = inverse::slope_change(slope, layout.n).by_sines;
  std::vector<double> cells(layout.cell_count());
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 p = (glm::dvec2(uniform(random), uniform(random)) - 0.5) * layout.facet();
    const double r = std::sqrt(uniform(random)), phi = 6.283185307179586 * uniform(random);
    const glm::dvec2 turned = widens * (layout.sun_radius * r * glm::dvec2(std::cos(phi), std::sin(phi))) +
                              layout.scatter * glm::dvec2(normal(random), normal(random));
    const glm::dvec2 at = layout.in_cells(layout.middle(facet) + p + slope * glm::dot(g, p) +
                                          (slope + turned) * (layout.distances[receiver] + height));
    if (at.x < 0 || at.y < 0 || at.x >= layout.cells.x || at.y >= layout.cells.y) continue;
    cells[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(layout.cells.x) + static_cast<std::size_t>(at.x)] +=
        1.0 / count;
  }
  return cells;
}

std::vector<double> computed(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver,
                             double height = 0) {
  std::vector<double> cells(layout.cell_count());
  for_cells(layout, inverse::footprint(layout, facet, slope, receiver, height),
            [&](std::size_t cell, double part) { cells[cell] = part; });
  return cells;
}

TEST(Footprint, HoldsAllOfABeamThatHitsTheReceiver) {
  const Layout layout = coarse();
  EXPECT_NEAR(total(computed(layout, 20, {0.1, -0.2}, 0)), 1, 1e-12);
  // Facet 0 is 6.25 mm from the left edge and as wide as that twice. Straight on, its shadow begins at the edge; a
  // slope that moves it half its width to the left leaves half of what its own shrinking leaves there.
  const double moved = -6.25 / 60;
  EXPECT_NEAR(total(computed(layout, 0, {moved, 0}, 0)), 0.5, 1e-9);
  EXPECT_EQ(total(computed(layout, 0, {-1, 0}, 0)), 0);
}

// Along one axis alone the product is exact: every cell within 5 standard errors of the drawn points.
TEST(Footprint, IsThatOfPointsOnTheFacet) {
  const Layout layout = coarse();
  const int count = 400000;
  for (const glm::dvec2& slope : {glm::dvec2(0, 0), glm::dvec2(0.35, 0), glm::dvec2(0, -0.4)})
    for (const std::size_t receiver : {0u, 1u}) {
      const std::vector<double> is = computed(layout, 27, slope, receiver),
                                truth = drawn(layout, 27, slope, receiver, count);
      for (std::size_t c = 0; c < is.size(); ++c)
        ASSERT_NEAR(is[c], truth[c], 5 * std::sqrt((is[c] + 1e-6) / count) + 1e-9)
            << c << " slope " << slope.x << " " << slope.y;
    }
}

// From a facet that stands higher, light has further to go: at a slope of 0.35, 8 mm are almost two cells.
TEST(Footprint, IsThatOfAFacetThatStandsHigher) {
  const Layout layout = coarse();
  const int count = 400000;
  const std::vector<double> is = computed(layout, 27, {0.35, 0}, 0, 8),
                            truth = drawn(layout, 27, {0.35, 0}, 0, count, 8);
  for (std::size_t c = 0; c < is.size(); ++c)
    ASSERT_NEAR(is[c], truth[c], 5 * std::sqrt((is[c] + 1e-6) / count) + 1e-9) << c;
}

// Across the axes both shadows are exact.
TEST(Footprint, HasTheShadowsOfAParallelogram) {
  const Layout layout = coarse();
  const int count = 400000;
  const glm::dvec2 slope{0.25, 0.2};
  const std::vector<double> is = computed(layout, 19, slope, 1), truth = drawn(layout, 19, slope, 1, count);
  for (const bool along_x : {true, false}) {
    const std::vector<double> a = sums(is, 64, along_x), b = sums(truth, 64, along_x);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 5 * std::sqrt((a[i] + 1e-6) / count)) << i;
  }
}

// The blur's box has the disc's and the roughness' variance: mean and variance of the shadow are right, its shape
// nearly so.
TEST(Footprint, IsBlurredByTheSunAndByRoughness) {
  Layout layout = coarse();
  layout.sun_radius = 0.03;
  layout.scatter = 0.02;
  const glm::dvec2 slope{-0.1, 0.05};
  const std::vector<double> is = sums(computed(layout, 28, slope, 1), 64, true),
                            truth = sums(drawn(layout, 28, slope, 1, 400000), 64, true);
  const auto moment = [](const std::vector<double>& v, double about, int power) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] * std::pow(static_cast<double>(i) - about, power);
    return sum;
  };
  const double mean = moment(truth, 0, 1);
  EXPECT_NEAR(moment(is, 0, 1), mean, 0.03);
  EXPECT_NEAR(moment(is, mean, 2), moment(truth, mean, 2), 0.01 * moment(truth, mean, 2));
  for (std::size_t i = 0; i < is.size(); ++i) EXPECT_NEAR(is[i], truth[i], 0.01) << i;
}

} // namespace nephroid::judge_test
