// SPDX-License-Identifier: Apache-2.0
// Free heights against surfaces that have no walls, and against every other choice of heights; the solid stays closed.
#include "inverse/bending.h"
#include "inverse/facets/heights.h"
#include "tests/inverse/sound.h"

namespace nephroid::heights_test {

using namespace inverse;

/// The slope that has this gradient: the tilt's own, against the direction in which z rises.
glm::dvec2 slope_with(const glm::dvec2& gradient, double n)
{
  const double steep = glm::length(gradient);
  return steep > 0 ? -gradient / steep * inverse::slope_behind(std::atan(steep), n) : glm::dvec2(0);
}

Layout tall(int columns, int rows)
{
  Layout layout = test::small(columns, rows);
  layout.thickness = 20;
  layout.free_heights = true;
  return layout;
}

/// Of a surface z(p) with this gradient at each facet's middle.
template <class F>
std::vector<glm::dvec2> slopes_of(const Layout& layout, const F& gradient)
{
  std::vector<glm::dvec2> slopes;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) slopes.push_back(slope_with(gradient(layout.middle(i)), layout.n));
  return slopes;
}

std::vector<glm::dvec2> gradients_of(const Layout& layout, const std::vector<glm::dvec2>& slopes)
{
  std::vector<glm::dvec2> gradients;
  for (const glm::dvec2& s : slopes) gradients.push_back(inverse::facet_gradient(s, layout.n));
  return gradients;
}

/// Sum over shared edges of the integral of the squared step, by Simpson's rule, which is exact for squares.
double squared_steps(const Layout& layout, const std::vector<glm::dvec2>& g, const std::vector<double>& h)
{
  const auto columns = static_cast<std::size_t>(layout.facets.x);
  double sum = 0;
  const auto edge = [&](std::size_t i, std::size_t j, const glm::dvec2& along) {
    const glm::dvec2 middle = (layout.middle(i) + layout.middle(j)) / 2.0;
    const auto step = [&](double t) {
      const glm::dvec2 p = middle + t * along;
      return h[i] + glm::dot(g[i], p - layout.middle(i)) - h[j] - glm::dot(g[j], p - layout.middle(j));
    };
    sum += glm::length(along) / 6 * (step(-0.5) * step(-0.5) + 4 * step(0) * step(0) + step(0.5) * step(0.5));
  };
  for (std::size_t i = 0; i < h.size(); ++i) {
    if ((i + 1) % columns) edge(i, i + 1, {0, layout.facet().y});
    if (i + columns < h.size()) edge(i, i + columns, {layout.facet().x, 0});
  }
  return sum;
}

TEST(Heights, ATiltBehavesAsItsGradient)
{
  for (const double n : {0.7, 1.5, 2.4})
    for (const glm::dvec2& g : {glm::dvec2(0.1, 0), glm::dvec2(-0.2, 0.15)}) {
      const glm::dvec2 back = inverse::facet_gradient(slope_with(g, n), n);
      EXPECT_NEAR(glm::length(back - (n > 1 ? g : -g)), 0, 1e-12) << n;
    }
}

// A plane: every facet lies in it, and there is no wall.
TEST(Heights, ATiltedPlaneHasNoWalls)
{
  const Layout layout = tall(13, 9);
  const glm::dvec2 g{0.3, -0.2};
  const Solid solid = make_solid(layout, slopes_of(layout, [&](const glm::dvec2&) { return g; }));
  EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
  EXPECT_NEAR(solid.relief(), 0.3 * 7 + 0.2 * 5, 1e-12);
  EXPECT_NEAR(solid.highest, solid.relief() / 2, 1e-12);
  for (std::size_t i = 0; i < layout.facet_count(); ++i) EXPECT_NEAR(solid.facets[i].height, glm::dot(g, layout.middle(i)), 1e-12);
  Layout flat = layout;
  flat.free_heights = false;
  EXPECT_GT(make_solid(flat, slopes_of(layout, [&](const glm::dvec2&) { return g; })).wall_area, 10);
}

// z = a x^2 / 2 + b y^2 / 2: facets that touch it in their middles, moved by a constant each, meet along their whole edges.
TEST(Heights, ALensIsContinuous)
{
  const Layout layout = tall(24, 15);
  const double a = 0.11, b = -0.07;
  const auto slopes = slopes_of(layout, [&](const glm::dvec2& p) { return glm::dvec2(a * p.x, b * p.y); });
  const Solid solid = make_solid(layout, slopes);
  EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
  const auto lens = [&](std::size_t i) {
    const glm::dvec2 p = layout.middle(i);
    return a * p.x * p.x / 2 + b * p.y * p.y / 2;
  };
  for (std::size_t i = 1; i < layout.facet_count(); ++i)
    EXPECT_NEAR(solid.facets[i].height - solid.facets[0].height, lens(i) - lens(0), 1e-12);
}

TEST(Heights, NoOthersHaveLowerWalls)
{
  Layout layout = tall(17, 12);
  const auto slopes = test::random_slopes(layout, 0.4, 3);
  const auto gradients = gradients_of(layout, slopes);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double band : {1e9, 0.5, 0.3}) { // 0.3: hardly more than a facet of 0.41 x 0.42 mm with these slopes
    layout.band = band;
    const std::vector<double> h = least_steps(layout, gradients);
    const double least = squared_steps(layout, gradients, h), half_x = layout.facet().x / 2, half_y = layout.facet().y / 2;
    const auto bound = [&](std::size_t i) { return band - std::abs(gradients[i].x) * half_x - std::abs(gradients[i].y) * half_y; };
    EXPECT_LT(least, squared_steps(layout, gradients, std::vector<double>(h.size())));
    std::size_t at_bound = 0;
    for (std::size_t i = 0; i < h.size(); ++i) {
      ASSERT_LE(std::abs(h[i]), bound(i) + 1e-12) << i;
      at_bound += std::abs(h[i]) > bound(i) - 1e-9;
      for (const double move : {-0.02, 0.02}) { // one alone
        std::vector<double> other = h;
        other[i] = std::clamp(h[i] + move, -bound(i), bound(i));
        EXPECT_GE(squared_steps(layout, gradients, other), least * (1 - 1e-6)) << i;
      }
    }
    EXPECT_EQ(at_bound > 0, band < 1);
    for (int round = 0; round < 50; ++round) { // all of them, by waves and by noise
      std::vector<double> other = h;
      const double kx = normal(random), ky = normal(random), noise = round % 2 ? 0.02 : 0;
      for (std::size_t i = 0; i < h.size(); ++i)
        other[i] = std::clamp(h[i] + 0.05 * std::cos(glm::dot({kx, ky}, layout.middle(i))) + noise * normal(random), -bound(i), bound(i));
      EXPECT_GE(squared_steps(layout, gradients, other), least * (1 - 1e-6));
    }
  }
}

// A facet that is alone, and rows of them.
TEST(Heights, OfOneFacetOrOneRow)
{
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1)}) {
    const Layout layout = tall(facets.x, facets.y);
    const Solid solid = make_solid(layout, slopes_of(layout, [](const glm::dvec2& p) { return glm::dvec2(0.1, 0.05 * p.y); }));
    EXPECT_NEAR(solid.highest_wall, 0, 1e-12);
    test::expect_sound(layout, solid);
  }
}

// Heights with and without ties, and nearly with: solved ones, drawn ones and those at a bound.
TEST(Heights, TheSolidIsClosedWithAny)
{
  for (int seed = 0; seed < 12; ++seed) {
    Layout layout = tall(19, 14);
    const auto slopes = test::random_slopes(layout, std::pow(10, -seed % 5) / 2, seed);
    if (seed % 2) layout.band = 0.6;
    test::expect_sound(layout, make_solid(layout, slopes));
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::vector<double> heights;
    for (std::size_t i = 0; i < layout.facet_count(); ++i)
      heights.push_back(static_cast<double>(random() % 4) * 0.5 + 1e-6 * static_cast<double>(random() % 3));
    test::expect_sound(layout, make_solid(layout, slopes, heights));
  }
}

// Flat heights are no solve: the same mesh as that of heights of 0.
TEST(Heights, FlatOnesAreZero)
{
  Layout layout = tall(11, 8);
  layout.free_heights = false;
  const auto slopes = test::random_slopes(layout, 0.5, 9);
  const Solid none = make_solid(layout, slopes), zeros = make_solid(layout, slopes, std::vector<double>(slopes.size()));
  EXPECT_EQ(none.mesh.positions, zeros.mesh.positions);
  EXPECT_EQ(none.mesh.triangles, zeros.mesh.triangles);
  EXPECT_EQ(inverse::heights_of(layout, slopes), std::vector<double>(slopes.size()));
}

} // namespace nephroid::heights_test
