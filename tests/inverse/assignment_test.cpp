// SPDX-License-Identifier: Apache-2.0
// Sweeps bring facets to the pictures: what they believe, that they only gain, and that they go on with the same bits.
#include "base/files.h"
#include "inverse/assign/assignment.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/pictures/target.h"
#include "tests/support/saved_jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace nephroid;
using inverse::Assignment;
using inverse::Cost;
using inverse::Layout;
using inverse::Picture;
using inverse::Target;

Layout small()
{
  Layout layout;
  layout.facets = {32, 32};
  layout.cells = {16, 16};
  layout.distances = {100, 200};
  return layout;
}

std::vector<Target> ring_and_disc(const Layout& layout)
{
  Picture ring, disc;
  ring.type = Picture::Type::ring;
  const FileFinder finder;
  return {make_target(ring, layout, finder, "ring"), make_target(disc, layout, finder, "disc")};
}

void sweep(Assignment& a, int sweeps)
{
  while (a.steps() < sweeps) a.advance();
}

TEST(Assignment, NeverLosesAndSoonHasThePictures)
{
  const Layout layout = small();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(layout, targets, 1);
  double before = a.residual();
  const double begin = mean(a.costs()).cost;
  while (a.steps() < 3) {
    a.advance();
    EXPECT_LE(a.residual(), before * (1 + 1e-12));
    before = a.residual();
  }
  EXPECT_GT(begin, 0.3);
  EXPECT_LT(mean(a.costs()).cost, 0.15);
}

// Every slope is below the limit, and the light on a receiver is what leaves the object less what is beside it.
TEST(Assignment, KeepsTheLightAndTheLimit)
{
  Layout layout = small();
  layout.n = 1.1; // bends by a slope of 0.46 at most
  layout.distances = {90, 110};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(layout, targets, 3);
  sweep(a, 2);
  double steepest = 0;
  for (const glm::dvec2& s : a.slopes()) steepest = std::max(steepest, glm::length(s));
  EXPECT_LE(steepest, inverse::usable_slope(1.1) * (1 + 1e-12));
  EXPECT_GT(steepest, 0.8 * inverse::usable_slope(1.1)); // the limit is met
  const std::vector<Cost> costs = a.costs();
  const double sent = inverse::light_sent(layout, a.slopes());
  for (const std::size_t j : {0u, 1u}) {
    const double light = std::accumulate(a.light(j).begin(), a.light(j).end(), 0.0);
    EXPECT_NEAR(light, sent * (1 - costs[j].missed), 1e-9 * sent);
    EXPECT_LT(costs[j].missed, 0.05);
  }
}

TEST(Assignment, GoesOnWithTheSameBits)
{
  const Layout layout = small();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment whole(layout, targets, 5), first(layout, targets, 5), second(layout, targets, 5), other(layout, targets, 6);
  for (int i = 0; i < 70; ++i) first.advance(); // 64 batches a sweep: in the middle of the second one
  ASSERT_TRUE(test::load<State>(second, test::saved<State>(first)));
  sweep(whole, 3);
  sweep(second, 3);
  sweep(other, 3);
  EXPECT_EQ(whole.slopes(), second.slopes());
  EXPECT_EQ(whole.light(1), second.light(1));
  EXPECT_NE(whole.slopes(), other.slopes());
}

// All facets together find more than one after the other: as much as several further sweeps.
TEST(Assignment, IsRefinedInItsLastSweep)
{
  Layout layout = small();
  layout.facets = {64, 64};
  layout.cells = {32, 32};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(layout, targets, 1);
  double before = a.residual();
  std::vector<double> sums{before};
  while (!a.finished()) {
    const std::int64_t sweeps = a.steps();
    a.advance();
    EXPECT_LE(a.residual(), before * (1 + 1e-12));
    before = a.residual();
    if (a.steps() > sweeps) sums.push_back(before);
  }
  ASSERT_GE(sums.size(), 4u);
  const double last_sweep = sums[sums.size() - 3] - sums[sums.size() - 2];
  EXPECT_GT(sums[sums.size() - 2] - before, 3 * last_sweep);
  // The light is that of the slopes, and these are below the limit.
  std::vector<std::vector<double>> light(2, std::vector<double>(layout.cell_count()));
  for (std::size_t i = 0; i < a.slopes().size(); ++i) add_light(layout, i, a.slopes()[i], 1, light);
  for (std::size_t c = 0; c < light[1].size(); ++c) EXPECT_NEAR(a.light(1)[c], light[1][c], 1e-9);
}

// Cut before the refinement, after some steps of it, and at its end.
TEST(Assignment, GoesOnWithTheSameBitsInTheRefinement)
{
  const Layout layout = small();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment whole(layout, targets, 5);
  std::vector<std::vector<std::byte>> cuts;
  for (std::uint64_t tried = 0; !whole.finished(); tried = whole.tried()) {
    whole.advance();
    if (whole.tried() - tried == layout.facet_count()) cuts.push_back(test::saved<State>(whole)); // a step moves all facets
  }
  ASSERT_GT(cuts.size(), 8u);
  for (const std::size_t cut : {std::size_t{0}, std::size_t{7}, cuts.size() - 1}) {
    Assignment other(layout, targets, 5);
    ASSERT_TRUE(test::load<State>(other, cuts[cut]));
    while (!other.finished()) other.advance();
    EXPECT_EQ(other.slopes(), whole.slopes());
    EXPECT_EQ(other.light(0), whole.light(0));
    EXPECT_EQ(other.steps(), whole.steps());
  }
}

TEST(Assignment, HasThePicturesOfAnObjectThatIsNotSquare)
{
  Layout layout;
  layout.size = {120, 60};
  layout.receiver = {80, 80};
  layout.facets = {64, 32};
  layout.cells = {24, 24};
  layout.distances = {150};
  Picture star;
  star.type = Picture::Type::star;
  star.count = 5;
  const std::vector<Target> targets{make_target(star, layout, FileFinder(), "star")};
  Assignment a(layout, targets, 1);
  sweep(a, 3);
  EXPECT_LT(a.costs()[0].cost, 0.12);
}

// Figures by hand: T / Tmax = 1, 1, 0, 0 and Z / Zmax = 1, 0.5, 0.5, 0.
TEST(Cost, IsThatOfTheThesisOverCellsWithLight)
{
  const Target t{0.5, 0.5, 0, 0};
  const std::vector<double> z{4, 2, 2, 0};
  const Cost c = inverse::cost_of(t, z, 10);
  EXPECT_NEAR(c.cost, std::sqrt((0.25 + 0.25) / 3), 1e-12);
  EXPECT_NEAR(c.cost_all, std::sqrt((0.25 + 0.25) / 4), 1e-12);
  EXPECT_NEAR(c.rel_l2, std::sqrt((0.25 * 0.25 * 2) / 0.5), 1e-12); // T / sum: .5 .5, Z / sum: .5 .25 .25
  EXPECT_NEAR(c.missed, 0.2, 1e-12);
  // A stray ray in a dark cell leaves the cells that count as they are.
  EXPECT_NEAR(inverse::cost_of(t, std::vector<double>{4, 2, 2, 0.01}, 10).cost, c.cost, 1e-9);
}

} // namespace
