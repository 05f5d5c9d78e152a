// SPDX-License-Identifier: Apache-2.0
// A facet's footprint against points drawn on it.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "tests/support/test.h"

namespace nephroid::footprint_test {

using inverse::Layout;

Layout coarse()
{
  Layout layout;
  layout.facets = {8, 6}; // a facet of 12.5 x 16.7 mm over cells of 1.56 mm
  layout.distances = {60, 130};
  return layout;
}

std::vector<double> sums(const std::vector<double>& cells, int columns, bool along_x)
{
  std::vector<double> all(static_cast<std::size_t>(columns));
  for (std::size_t c = 0; c < cells.size(); ++c)
    all[along_x ? c % static_cast<std::size_t>(columns) : c / static_cast<std::size_t>(columns)] += cells[c];
  return all;
}

/// Points of the facet, each sent on its way from its own height; blurred as the sun's disc and a rough surface do.
std::vector<double> drawn(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver, int count,
                          double height = 0)
{
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
    const glm::dvec2 at =
        layout.in_cells(layout.middle(facet) + p + slope * glm::dot(g, p) + (slope + turned) * (layout.distances[receiver] + height));
    if (at.x < 0 || at.y < 0 || at.x >= layout.cells.x || at.y >= layout.cells.y) continue;
    cells[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(layout.cells.x) + static_cast<std::size_t>(at.x)] += 1.0 / count;
  }
  return cells;
}

std::vector<double> computed(const Layout& layout, std::size_t facet, const glm::dvec2& slope, std::size_t receiver, double height = 0)
{
  const inverse::Footprint print = inverse::footprint(layout, facet, slope, receiver, height);
  std::vector<double> cells(layout.cell_count());
  for (std::size_t k = 0; k < print.y.size(); ++k)
    for (std::size_t i = 0; i < print.x.size(); ++i)
      cells[(static_cast<std::size_t>(print.y0) + k) * static_cast<std::size_t>(layout.cells.x) + static_cast<std::size_t>(print.x0) + i] =
          print.x[i] * print.y[k];
  return cells;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(Footprint, HoldsAllOfABeamThatHitsTheReceiver)
{
  const Layout layout = coarse();
  EXPECT_NEAR(total(computed(layout, 20, {0.1, -0.2}, 0)), 1, 1e-12);
  // Facet 0 is 6.25 mm from the left edge and as wide as that twice. Straight on, its shadow begins at the edge; a slope that moves it
  // half its width to the left leaves half of what its own shrinking leaves there.
  const double moved = -6.25 / 60;
  EXPECT_NEAR(total(computed(layout, 0, {moved, 0}, 0)), 0.5, 1e-9);
  EXPECT_EQ(total(computed(layout, 0, {-1, 0}, 0)), 0);
}

// Along one axis alone the product is exact: every cell within 5 standard errors of the drawn points.
TEST(Footprint, IsThatOfPointsOnTheFacet)
{
  const Layout layout = coarse();
  const int count = 400000;
  for (const glm::dvec2& slope : {glm::dvec2(0, 0), glm::dvec2(0.35, 0), glm::dvec2(0, -0.4)})
    for (const std::size_t receiver : {0u, 1u}) {
      const std::vector<double> is = computed(layout, 27, slope, receiver), truth = drawn(layout, 27, slope, receiver, count);
      for (std::size_t c = 0; c < is.size(); ++c)
        ASSERT_NEAR(is[c], truth[c], 5 * std::sqrt((is[c] + 1e-6) / count) + 1e-9) << c << " slope " << slope.x << " " << slope.y;
    }
}

// From a facet that stands higher, light has further to go: at a slope of 0.35, 8 mm are almost two cells.
TEST(Footprint, IsThatOfAFacetThatStandsHigher)
{
  const Layout layout = coarse();
  const int count = 400000;
  const std::vector<double> is = computed(layout, 27, {0.35, 0}, 0, 8), truth = drawn(layout, 27, {0.35, 0}, 0, count, 8);
  for (std::size_t c = 0; c < is.size(); ++c) ASSERT_NEAR(is[c], truth[c], 5 * std::sqrt((is[c] + 1e-6) / count) + 1e-9) << c;
}

// Across the axes both shadows are exact.
TEST(Footprint, HasTheShadowsOfAParallelogram)
{
  const Layout layout = coarse();
  const int count = 400000;
  const glm::dvec2 slope{0.25, 0.2};
  const std::vector<double> is = computed(layout, 19, slope, 1), truth = drawn(layout, 19, slope, 1, count);
  for (const bool along_x : {true, false}) {
    const std::vector<double> a = sums(is, 64, along_x), b = sums(truth, 64, along_x);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 5 * std::sqrt((a[i] + 1e-6) / count)) << i;
  }
}

// The blur's box has the disc's and the roughness' variance: mean and variance of the shadow are right, its shape nearly so.
TEST(Footprint, IsBlurredByTheSunAndByRoughness)
{
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

} // namespace nephroid::footprint_test
