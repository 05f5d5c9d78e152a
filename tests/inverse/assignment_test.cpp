// SPDX-License-Identifier: Apache-2.0
// Sweeps bring facets to the pictures: what they believe, that they only gain, and that they go on with the same bits.
// Their cost and its smoothing.
#include "inverse/assign/assignment.h"
#include "inverse/assign/conflicts.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "tests/inverse/searches.h"
#include "tests/inverse/sound.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::assignment_test {

using namespace inverse;

TEST(Assignment, NeverLosesAndSoonHasThePictures) {
  const Layout layout = small_layout();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 1);
  double before = a.residual();
  const double begin = mean(a.costs()).cost;
  while (a.steps() < 3) {
    const std::int64_t sweeps = a.steps();
    a.advance();
    if (a.steps() == sweeps) { // a new one has other tones
      EXPECT_LE(a.residual(), before * (1 + 1e-6));
    }
    before = a.residual();
  }
  EXPECT_GT(begin, 0.3);
  EXPECT_LT(mean(a.costs()).cost, 0.15);
  // No facet's light was lost on the way: nobody moved in another's cells.
  const std::vector<std::vector<double>> light = light_of_all(layout, a.slopes(), a.heights());
  for (std::size_t c = 0; c < light[0].size(); ++c) EXPECT_NEAR(a.light(0)[c], light[0][c], 1e-4);
}

// Every slope is below the limit, and the light on a receiver is what leaves the object less what is beside it.
TEST(Assignment, KeepsTheLightAndTheLimit) {
  Layout layout = small_layout();
  layout.n = 1.1; // bends by a slope of 0.46 at most
  layout.distances = {90, 110};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 3);
  sweep(a, 2);
  double steepest = 0;
  for (const glm::dvec2& s : a.slopes()) steepest = std::max(steepest, glm::length(s));
  EXPECT_LE(steepest, inverse::usable_slope(1.1) * (1 + 1e-6));
  EXPECT_GT(steepest, 0.8 * inverse::usable_slope(1.1)); // the limit is met
  const std::vector<Cost> costs = a.costs();
  const double sent = inverse::light_sent(layout, a.slopes());
  for (const std::size_t j : {0u, 1u}) {
    const double light = std::accumulate(a.light(j).begin(), a.light(j).end(), 0.0);
    EXPECT_NEAR(light, sent * (1 - costs[j].missed), 1e-6 * sent);
    EXPECT_LT(costs[j].missed, 0.1);
  }
}

TEST(Assignment, GoesOnWithTheSameBits) {
  const Layout layout = small_layout();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment whole(test::shared_context(), layout, targets, 5), first(test::shared_context(), layout, targets, 5),
      second(test::shared_context(), layout, targets, 5), other(test::shared_context(), layout, targets, 6);
  for (int i = 0; i < 70; ++i) first.advance(); // 64 batches a sweep: in the middle of the second one
  ASSERT_TRUE(test::load<Archive>(second, test::saved<Archive>(first)));
  sweep(whole, 3);
  sweep(second, 3);
  sweep(other, 3);
  EXPECT_EQ(whole.slopes(), second.slopes());
  EXPECT_EQ(whole.light(1), second.light(1));
  EXPECT_NE(whole.slopes(), other.slopes());
}

// All facets together find more than one after the other: as much as several further sweeps.
TEST(Assignment, IsRefinedInItsLastSweep) {
  Layout layout = small_layout();
  layout.facets = {64, 64};
  layout.cells = {32, 32};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 1);
  double before = a.residual();
  std::vector<double> sums{before};
  while (!a.finished()) {
    const std::int64_t sweeps = a.steps();
    a.advance();
    if (a.steps() == sweeps) {
      EXPECT_LE(a.residual(), before * (1 + 1e-6));
    }
    before = a.residual();
    if (a.steps() > sweeps) sums.push_back(before);
  }
  ASSERT_GE(sums.size(), 4u);
  const double last_sweep = sums[sums.size() - 3] - sums[sums.size() - 2];
  EXPECT_GT(sums[sums.size() - 2] - before, 3 * last_sweep);
  // The light is that of the slopes, and these are below the limit.
  std::vector<std::vector<double>> light(2, std::vector<double>(layout.cell_count()));
  for (std::size_t i = 0; i < a.slopes().size(); ++i) add_light(layout, i, a.slopes()[i], 1, light);
  for (std::size_t c = 0; c < light[1].size(); ++c) EXPECT_NEAR(a.light(1)[c], light[1][c], 1e-4);
}

// Cut before the refinement, after some steps of it, and at its end.
TEST(Assignment, GoesOnWithTheSameBitsInTheRefinement) {
  const Layout layout = small_layout();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment whole(test::shared_context(), layout, targets, 5);
  std::vector<std::vector<std::byte>> cuts;
  for (std::uint64_t tried = 0; !whole.finished(); tried = whole.tried()) {
    whole.advance();
    if (whole.tried() - tried == layout.facet_count())
      cuts.push_back(test::saved<Archive>(whole)); // a step moves all facets
  }
  ASSERT_GT(cuts.size(), 8u);
  for (const std::size_t cut : {std::size_t{0}, std::size_t{7}, cuts.size() - 1}) {
    Assignment other(test::shared_context(), layout, targets, 5);
    ASSERT_TRUE(test::load<Archive>(other, cuts[cut]));
    while (!other.finished()) other.advance();
    EXPECT_EQ(other.slopes(), whole.slopes());
    EXPECT_EQ(other.light(0), whole.light(0));
    EXPECT_EQ(other.steps(), whole.steps());
  }
}

TEST(Assignment, HasThePicturesOfAnObjectThatIsNotSquare) {
  Layout layout{.size = {120, 60}, .facets = {64, 32}, .receiver = {80, 80}, .cells = {24, 24}, .distances = {150}};
  const Picture star{.type = Picture::Type::star, .count = 5};
  const std::vector<Target> targets{drawn(star, layout)};
  Assignment a(test::shared_context(), layout, targets, 1);
  sweep(a, 3);
  EXPECT_LT(a.costs()[0].cost, 0.12);
}

// Figures by hand: T / Tmax = 1, 1, 0, 0 and Z / Zmax = 1, 0.5, 0.5, 0.
// Two receivers that no ray reaches both share the light: each has half, in its own tone. Wanted of all light, the dark
// half of a gradient would get none.
TEST(Assignment, GivesReceiversBesideEachOtherTheirParts) {
  Layout layout = small_layout();
  layout.distances = {150, 155};
  layout.offsets = {{{-80, 0}, {80, 0}}};
  Target gradient;
  for (std::size_t c = 0; c < layout.cell_count(); ++c)
    gradient.push_back(1 + static_cast<double>(c % static_cast<std::size_t>(layout.cells.x)));
  const double sum = std::accumulate(gradient.begin(), gradient.end(), 0.0);
  for (double& cell : gradient) cell /= sum;
  const std::vector<Target> targets(2, gradient);
  Assignment a(test::shared_context(), layout, targets, 1);
  sweep(a, 5);
  for (const Cost& cost : a.costs()) {
    EXPECT_GT(cost.missed, 0.5);
    EXPECT_LT(cost.missed, 0.8);
    EXPECT_LT(cost.rel_l2, 0.1);
  }
}

TEST(Cost, IsThatOfTheThesisOverCellsWithLight) {
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

// Smoothing: its figure by hand, that it makes the object smoother, and that none of it is no term.

// Two rows of three; one facet in the middle of the upper row tilted by theta against all others, which lie flat. It
// has 3 neighbours, each unlike it alone: 1 - cos theta for itself; of its neighbours, two have 2 of their own and one
// has 3.
TEST(Smoothing, RoughnessIsCostN) {
  Layout layout{.facets = {3, 2}};
  std::vector<glm::dvec2> slopes(6);
  EXPECT_NEAR(roughness(layout, slopes), 0, 1e-15);
  slopes[1] = {0.3, -0.2};
  const double c = 1 / std::sqrt(1 + std::pow(glm::length(inverse::facet_gradient(slopes[1], layout.n)), 2));
  EXPECT_NEAR(roughness(layout, slopes), (1 - c) * (1 + 0.5 + 0.5 + 1 / 3.0) / 6, 1e-12);
}

struct Made {
  double cost = 0, roughness = 0;
};

Made made(double smoothing) {
  Layout layout{.facets = {32, 32}, .cells = {16, 16}, .distances = {100, 200}, .smoothing = smoothing};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 1);
  double before = a.residual();
  while (a.steps() < 3) {
    const std::int64_t sweeps = a.steps();
    a.advance();
    if (a.steps() == sweeps) {
      EXPECT_LE(a.residual(), before * (1 + 1e-6)); // of both terms together
    }
    before = a.residual();
  }
  return {mean(a.costs()).cost, roughness(layout, a.slopes())};
}

TEST(Smoothing, CostsErrorAndMakesSmoother) {
  const Made none = made(0), some = made(0.3), much = made(100);
  EXPECT_LT(some.roughness, 0.9 * none.roughness);
  EXPECT_LT(much.roughness, 0.2 * none.roughness);
  EXPECT_GT(much.cost, none.cost);
}

// A weight so small that it turns no choice is as good as none, which has no term; but neighbours wait for each other.
TEST(Smoothing, NoneIsAsATermOfNoWeight) {
  const Made none = made(0), little = made(1e-30);
  EXPECT_NEAR(little.cost, none.cost, 0.25 * none.cost);
  EXPECT_NEAR(little.roughness, none.roughness, 0.1 * none.roughness);
}

// Which pictures fight: none where light can serve both, all of it where it cannot, and no third one is blamed.

/// Cells of these columns and rows, half open, of 16 x 16.
Target box(int left, int right, int top = 0, int bottom = 16) {
  Target target(256);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      target[static_cast<std::size_t>(16 * y + x)] = 1.0 / ((right - left) * (bottom - top));
  return target;
}

struct Found {
  Layout layout;
  std::vector<Target> targets;
  std::vector<glm::dvec2> slopes;
  std::vector<double> heights;
  std::vector<std::vector<double>> light;

  ConflictSearch search() const { return ConflictSearch(layout, targets, slopes, heights, light); }
};

Found assigned(const std::vector<double>& distances, const std::vector<Target>& targets) {
  Found found{.layout = {.facets = {64, 64}, .cells = {16, 16}, .distances = distances}, .targets = targets};
  Assignment a(test::shared_context(), found.layout, targets, 1);
  while (!a.finished()) a.advance();
  found.slopes = a.slopes();
  found.heights = a.heights();
  for (std::size_t j = 0; j < targets.size(); ++j) found.light.push_back(a.light(j));
  return found;
}

double fight(const Conflicts& c, std::size_t j, std::size_t k) { return c.between[j][k] + c.between[k][j]; }

// Light that goes straight on makes the same picture at any distance: here the whole receiver.
TEST(Conflicts, NoneWhereStraightLightMakesBoth) {
  EXPECT_LT(fight(assigned({100, 200}, {box(0, 16), box(0, 16)}).search().picture_conflicts(), 0, 1), 0.05);
}

// Through a first receiver's left edge no light comes to a second one's right edge. A facet serves one of them: all of
// the light is misplaced in one, for the other's sake.
TEST(Conflicts, AllLightWherePicturesExcludeEachOther) {
  const Found found = assigned({100, 200}, {box(0, 2, 6, 10), box(14, 16, 6, 10)});
  const Conflicts c = found.search().picture_conflicts();
  EXPECT_NEAR(c.misplaced[0] + c.misplaced[1], 1, 0.1);
  EXPECT_NEAR(fight(c, 0, 1), 1, 0.15);
  const std::vector<double> facets = found.search().facet_conflicts();
  for (const double facet : facets) EXPECT_LE(facet, 1);
  EXPECT_GT(std::accumulate(facets.begin(), facets.end(), 0.0) / 4096, 0.85);
}

// What is misplaced by facets is what the picture lacks elsewhere: |Z - T| / 2 of light that is all there.
TEST(Conflicts, AddUpToTheError) {
  Layout layout{.facets = {32, 32}, .cells = {16, 16}, .distances = {100}};
  const std::vector<Target> targets{box(3, 9, 2, 12)};
  const Assignment a(test::shared_context(), layout, targets, 4); // random slopes, all of them to the receiver
  const double sent = inverse::light_sent(layout, a.slopes());
  double lacking = 0;
  for (std::size_t c = 0; c < 256; ++c) lacking += std::max(0.0, targets[0][c] - a.light(0)[c] / sent);
  const std::vector<double> heights = a.heights();
  const std::vector<std::vector<double>> light{a.light(0)};
  const ConflictSearch search(layout, targets, a.slopes(), heights, light);
  EXPECT_NEAR(search.picture_conflicts().misplaced[0], lacking, 1e-6);
}

// Between two that exclude each other stands a third, which is what their light makes there by itself.
TEST(Conflicts, BlameNoThird) {
  Found found = assigned({100, 200}, {box(0, 2, 6, 10), box(14, 16, 6, 10)});
  found.layout.distances = {100, 130, 200};
  found.light.assign(3, std::vector<double>(256));
  for (std::size_t i = 0; i < found.slopes.size(); ++i) add_light(found.layout, i, found.slopes[i], 1, found.light);
  const double received = std::accumulate(found.light[1].begin(), found.light[1].end(), 0.0);
  found.targets.insert(found.targets.begin() + 1, found.light[1]);
  for (double& t : found.targets[1]) t /= received;
  const Conflicts c = found.search().picture_conflicts();
  EXPECT_NEAR(c.misplaced[1], 1 - received / inverse::light_sent(found.layout, found.slopes),
              1e-6); // what is beside the receiver
  EXPECT_GT(fight(c, 0, 2), 0.8);
  EXPECT_LT(fight(c, 0, 1), 0.1 * fight(c, 0, 2));
  EXPECT_LT(fight(c, 1, 2), 0.1 * fight(c, 0, 2));
}

} // namespace nephroid::assignment_test
