// SPDX-License-Identifier: Apache-2.0
// Smoothing: its figure by hand, what one facet changes, that it makes the object smoother, and that none of it is no term.
#include "base/files.h"
#include "inverse/assign/assignment.h"
#include "inverse/assign/cost.h"
#include "inverse/bending.h"
#include "inverse/pictures/target.h"
#include "tests/inverse/sound.h"

namespace nephroid::smoothing_test {

using namespace inverse;

// Two rows of three; one facet in the middle of the upper row tilted by theta against all others, which lie flat. It has 3 neighbours, each
// unlike it alone: 1 - cos theta for itself; of its neighbours, two have 2 of their own and one has 3.
TEST(Smoothing, RoughnessIsCostN)
{
  Layout layout;
  layout.facets = {3, 2};
  std::vector<glm::dvec2> slopes(6);
  EXPECT_NEAR(roughness(layout, slopes), 0, 1e-15);
  slopes[1] = {0.3, -0.2};
  const double c = 1 / std::sqrt(1 + std::pow(glm::length(inverse::facet_gradient(slopes[1], layout.n)), 2));
  EXPECT_NEAR(roughness(layout, slopes), (1 - c) * (1 + 0.5 + 0.5 + 1 / 3.0) / 6, 1e-12);
}

// The sum falls by what the pull says, whichever facet moves.
TEST(Smoothing, ThePullIsWhatAFacetChanges)
{
  const Layout layout = test::small(5, 4);
  const auto slopes = test::random_slopes(layout, 0.5, 1);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    auto moved = slopes;
    moved[i] = {0.1, -0.3};
    const glm::dvec3 change = inverse::normal_of(layout, i, moved[i]) - inverse::normal_of(layout, i, slopes[i]);
    EXPECT_NEAR(20 * (roughness(layout, moved) - roughness(layout, slopes)), -glm::dot(change, pull(layout, slopes, i)), 1e-12) << i;
  }
}

struct Made {
  double cost = 0, roughness = 0;
  std::vector<glm::dvec2> slopes;
};

Made made(double smoothing)
{
  Layout layout;
  layout.facets = {32, 32};
  layout.cells = {16, 16};
  layout.distances = {100, 200};
  layout.smoothing = smoothing;
  Picture ring, disc;
  ring.type = Picture::Type::ring;
  const FileFinder finder;
  const std::vector<Target> targets{make_target(ring, layout, finder, "ring"), make_target(disc, layout, finder, "disc")};
  Assignment a(layout, targets, 1);
  double before = a.residual();
  while (a.steps() < 3) {
    a.advance();
    EXPECT_LE(a.residual(), before * (1 + 1e-12)); // of both terms together
    before = a.residual();
  }
  return {mean(a.costs()).cost, roughness(layout, a.slopes()), a.slopes()};
}

TEST(Smoothing, CostsErrorAndMakesSmoother)
{
  const Made none = made(0), some = made(0.3), much = made(100);
  EXPECT_LT(some.roughness, 0.9 * none.roughness);
  EXPECT_LT(much.roughness, 0.2 * none.roughness);
  EXPECT_GT(much.cost, none.cost);
}

// A weight so small that it turns no choice gives the same slopes as none, which has no term.
TEST(Smoothing, NoneIsTheSameAsATermOfNoWeight) { EXPECT_EQ(made(0).slopes, made(1e-300).slopes); }

} // namespace nephroid::smoothing_test
