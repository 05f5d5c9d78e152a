// SPDX-License-Identifier: Apache-2.0
// Which pictures fight: none where light can serve both, all of it where it cannot, and no third one is blamed.
#include "inverse/assign/assignment.h"
#include "inverse/assign/conflicts.h"
#include "inverse/assign/footprint.h"
#include "tests/support/test.h"

namespace nephroid::conflicts_test {

using namespace inverse;

/// Cells of these columns and rows, half open, of 16 x 16.
Target box(int left, int right, int top = 0, int bottom = 16)
{
  Target target(256);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) target[static_cast<std::size_t>(16 * y + x)] = 1.0 / ((right - left) * (bottom - top));
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

Found assigned(const std::vector<double>& distances, const std::vector<Target>& targets)
{
  Found found;
  found.layout.facets = {64, 64};
  found.layout.cells = {16, 16};
  found.layout.distances = distances;
  found.targets = targets;
  Assignment a(found.layout, targets, 1);
  while (!a.finished()) a.advance();
  found.slopes = a.slopes();
  found.heights = a.heights();
  for (std::size_t j = 0; j < targets.size(); ++j) found.light.push_back(a.light(j));
  return found;
}

double fight(const Conflicts& c, std::size_t j, std::size_t k) { return c.between[j][k] + c.between[k][j]; }

// Light that goes straight on makes the same picture at any distance: here the whole receiver.
TEST(Conflicts, NoneWhereStraightLightMakesBoth)
{
  const Found found = assigned({100, 200}, {box(0, 16), box(0, 16)});
  EXPECT_LT(fight(found.search().of_pictures(), 0, 1), 0.05);
}

// Through a first receiver's left edge no light comes to a second one's right edge. A facet serves one of them: all of the light is
// misplaced in one, for the other's sake.
TEST(Conflicts, AllLightWherePicturesExcludeEachOther)
{
  const Found found = assigned({100, 200}, {box(0, 2, 6, 10), box(14, 16, 6, 10)});
  const Conflicts c = found.search().of_pictures();
  EXPECT_NEAR(c.misplaced[0] + c.misplaced[1], 1, 0.1);
  EXPECT_NEAR(fight(c, 0, 1), 1, 0.15);
  const std::vector<double> facets = found.search().of_facets();
  for (const double facet : facets) EXPECT_LE(facet, 1);
  EXPECT_GT(std::accumulate(facets.begin(), facets.end(), 0.0) / 4096, 0.85);
}

// What is misplaced by facets is what the picture lacks elsewhere: |Z - T| / 2 of light that is all there.
TEST(Conflicts, AddUpToTheError)
{
  Layout layout;
  layout.facets = {32, 32};
  layout.cells = {16, 16};
  layout.distances = {100};
  const std::vector<Target> targets{box(3, 9, 2, 12)};
  const Assignment a(layout, targets, 4); // random slopes, all of them to the receiver
  const double sent = inverse::light_sent(layout, a.slopes());
  double lacking = 0;
  for (std::size_t c = 0; c < 256; ++c) lacking += std::max(0.0, targets[0][c] - a.light(0)[c] / sent);
  const std::vector<double> heights = a.heights();
  const std::vector<std::vector<double>> light{a.light(0)};
  const ConflictSearch search(layout, targets, a.slopes(), heights, light);
  EXPECT_NEAR(search.of_pictures().misplaced[0], lacking, 1e-9);
}

// Between two that exclude each other stands a third, which is what their light makes there by itself.
TEST(Conflicts, BlameNoThird)
{
  Found found = assigned({100, 200}, {box(0, 2, 6, 10), box(14, 16, 6, 10)});
  found.layout.distances = {100, 130, 200};
  found.light.assign(3, std::vector<double>(256));
  for (std::size_t i = 0; i < found.slopes.size(); ++i) add_light(found.layout, i, found.slopes[i], 1, found.light);
  const double sent = inverse::light_sent(found.layout, found.slopes);
  found.targets.insert(found.targets.begin() + 1, found.light[1]);
  for (double& t : found.targets[1]) t /= sent;
  const Conflicts c = found.search().of_pictures();
  EXPECT_LT(c.misplaced[1], 0.05);
  EXPECT_GT(fight(c, 0, 2), 0.8);
  EXPECT_LT(fight(c, 0, 1), 0.1 * fight(c, 0, 2));
  EXPECT_LT(fight(c, 1, 2), 0.1 * fight(c, 0, 2));
}

} // namespace nephroid::conflicts_test
