// SPDX-License-Identifier: Apache-2.0
// The thesis' pipeline: draws from the joint probability, what is done to pictures, annealing; and as a whole: what its
// stages gain, that it ends, and that it goes on with the same bits.
#include "inverse/thesis/pipeline.h"
#include "inverse/thesis/sampler.h"
#include "inverse/uniform.h"
#include "tests/inverse/searches.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::thesis_test {

using namespace inverse;

class ThesisPipeline : public testing::Test {
protected:
  ThesisPipeline() {
    settings.cycles = 3;
    settings.moves = 2;
    settings.corrections = 5;
    settings.directions = 48;
  }

  /// Light through the left edge of the first receiver never comes to the right edge of the second.
  void light_edges() {
    targets.assign(2, Target(256));
    targets[0][8 * 16 + 0] = 1;
    targets[1][8 * 16 + 15] = 1;
  }
  static job::Snapshot finish(Pipeline& pipeline) {
    while (!pipeline.finished()) pipeline.advance();
    job::Snapshot snapshot;
    pipeline.show(snapshot);
    return snapshot;
  }

  Layout layout = small_layout(); // two pieces of work a trial
  std::vector<Target> targets = ring_and_disc(layout);
  Thesis settings;
};

TEST_F(ThesisPipeline, GainsInEveryStageAndEnds) {
  settings.cycles = 5;
  for (const Thesis::Adjust adjust : {Thesis::Adjust::convergence, Thesis::Adjust::each}) {
    settings.adjust = adjust;
    Pipeline pipeline(layout, targets, settings, 1);
    const job::Snapshot s = finish(pipeline);
    EXPECT_LE(pipeline.steps(), pipeline.most());
    for (const char* stage : {"annealing_1", "annealing_2", "correction"})
      EXPECT_GE(job::scalar(s, "thesis", std::string("gain_") + stage), 0) << stage;
    EXPECT_GT(job::scalar(s, "thesis", "gain_annealing_1"), 0.005);
    EXPECT_GT(job::scalar(s, "thesis", "gain_correction"), 0.05);
    EXPECT_EQ(job::scalar(s, "thesis", "dark_facets"), 0);
    const job::Curve& curve = s.curves.at(0);
    EXPECT_EQ(curve.rows.size(), static_cast<std::size_t>(pipeline.steps()));
    EXPECT_EQ(curve.rows[10][1], 1); // the stage
    EXPECT_EQ(curve.rows[10][5] + curve.rows[10][6], 10);
    EXPECT_EQ(curve.rows[20][1], 2);
    EXPECT_EQ(curve.rows[10][2], settings.temperature * std::pow(0.5, 4));
  }
}

TEST_F(ThesisPipeline, GoesOnWithTheSameBitsInEveryStage) {
  for (const Thesis::Adjust adjust : {Thesis::Adjust::convergence, Thesis::Adjust::each}) {
    settings.adjust = adjust;
    Pipeline whole(layout, targets, settings, 7);
    std::vector<std::vector<std::byte>> cuts;
    for (int i = 0; !whole.finished(); ++i) {
      if (i % 3 == 1) cuts.push_back(test::saved<Archive>(whole)); // between trials and in the middle of one
      whole.advance();
    }
    cuts.push_back(test::saved<Archive>(whole));
    for (const auto& cut : cuts) {
      Pipeline other(layout, targets, settings, 7);
      ASSERT_TRUE(test::load<Archive>(other, cut));
      const job::Curve curve = finish(other).curves.at(0);
      ASSERT_EQ(other.slopes(), whole.slopes());
      ASSERT_EQ(other.light(0), whole.light(0));
      ASSERT_EQ(curve.rows, finish(whole).curves.at(0).rows);
    }
    Pipeline seeded(layout, targets, settings, 8);
    finish(seeded);
    EXPECT_NE(seeded.slopes(), whole.slopes());
  }
}

// Such facets are counted, nothing loops or becomes infinite, and the cost is the highest that there is.
TEST_F(ThesisPipeline, CountsFacetsWithoutADirection) {
  light_edges();
  settings.sampling = Thesis::Sampling::rejection;
  settings.cycles = 0;
  Pipeline pipeline(layout, targets, settings, 1);
  const job::Snapshot s = finish(pipeline);
  EXPECT_EQ(job::scalar(s, "thesis", "dark_facets"), 1024);
  EXPECT_EQ(job::scalar(s, "thesis", "cost_correction"), 1);
  EXPECT_EQ(job::scalar(s, "thesis", "missing_cells_1"), 1);
  EXPECT_THAT(s.warnings.at(0), HasSubstr("1024 facets can send light nowhere where all pictures are lit"));
  EXPECT_EQ(pipeline.slopes()[77], glm::dvec2(0));
  EXPECT_EQ(pipeline.steps(), 1 + settings.patience); // rounds without a gain
}

// With extension and overshoot the same facets find their way.
TEST_F(ThesisPipeline, ReachesMissingCellsBySecondAnnealing) {
  light_edges();
  settings.size_limit = 0;
  Pipeline pipeline(layout, targets, settings, 1);
  const job::Snapshot s = finish(pipeline);
  EXPECT_LT(job::scalar(s, "thesis", "dark_facets"), 1024);
  EXPECT_EQ(job::scalar(s, "thesis", "gain_annealing_1"), 0);
  EXPECT_GT(job::scalar(s, "thesis", "gain_annealing_2"), 0.05);
}

constexpr Thesis::Sampling both[] = {Thesis::Sampling::exact, Thesis::Sampling::rejection};

/// A facet in the middle, on the axis; cells of 10 mm.
Layout one_facet() {
  return {.size = {90, 90}, .facets = {1, 1}, .receiver = {90, 90}, .cells = {9, 9}, .distances = {100, 200}};
}

/// Of 9 x 9 cells: 1 in these, which are columns of the middle row.
std::vector<double> lit(const std::vector<std::size_t>& columns) {
  std::vector<double> picture(81);
  for (const std::size_t x : columns) picture[4 * 9 + x] = 1;
  return picture;
}

TEST(ThesisSampler, DrawsCellsAsOftenAsTheyAreBright) {
  Layout layout = one_facet();
  std::vector<double> picture = lit({2, 7});
  picture[4 * 9 + 7] = 0.25;
  for (const Thesis::Sampling sampling : both) {
    const Thesis settings{.sampling = sampling, .directions = 90}; // ten a cell
    std::mt19937_64 random(1);
    const Draws draws = Sampler(layout, {{100, picture, 0}}, settings).draw(0, 5000, random);
    ASSERT_EQ(draws.cells.size(), 5000u);
    double bright = 0;
    for (std::size_t i = 0; i < 5000; ++i) {
      ASSERT_TRUE(draws.cells[i] == 4 * 9 + 2 || draws.cells[i] == 4 * 9 + 7);
      const glm::dvec2 at = layout.in_cells(draws.slopes[i] * 100.0); // where the light goes is where it is counted
      ASSERT_EQ(static_cast<int>(at.y) * 9 + static_cast<int>(at.x), draws.cells[i]);
      bright += draws.cells[i] == 4 * 9 + 2;
    }
    EXPECT_NEAR(bright / 5000, 0.8, 4 * std::sqrt(0.8 * 0.2 / 5000));
  }
}

// (5.1) by brute force: for each cell of the first receiver the product of both pictures, over many directions through
// it.
TEST(ThesisSampler, FollowsTheProductOfThePictures) {
  Layout layout{.facets = {4, 4}, .cells = {6, 6}, .distances = {100, 150}};
  std::mt19937_64 random(5);
  std::vector<SamplingTarget> aims{{100, {}, 0}, {150, {}, 0}};
  for (SamplingTarget& aim : aims)
    for (int i = 0; i < 36; ++i) aim.picture.push_back(inverse::uniform(random));
  const std::size_t facet = 2;
  std::vector<double> expected(36);
  constexpr int fine = 1200;
  for (int i = 0; i < fine * fine; ++i) {
    const glm::dvec2 first = (glm::dvec2(i % fine + 0.5, i / fine + 0.5) / double(fine) - 0.5) * 100.0,
                     from = layout.middle(facet), second = from + (first - from) * 1.5, a = layout.in_cells(first),
                     b = layout.in_cells(second);
    if (b.x < 0 || b.y < 0 || b.x >= 6 || b.y >= 6) continue;
    const std::size_t cell = static_cast<std::size_t>(a.y) * 6 + static_cast<std::size_t>(a.x);
    expected[cell] +=
        aims[0].picture[cell] * aims[1].picture[static_cast<std::size_t>(b.y) * 6 + static_cast<std::size_t>(b.x)];
  }
  const double all = std::accumulate(expected.begin(), expected.end(), 0.0);
  for (const Thesis::Sampling sampling : both) {
    Thesis settings{.sampling = sampling, .directions = 300};
    constexpr int count = 20000;
    const Draws draws = Sampler(layout, aims, settings).draw(facet, count, random);
    std::vector<double> counts(36);
    for (std::size_t i = 0; i < draws.cells.size(); i += 2) ++counts[static_cast<std::size_t>(draws.cells[i])];
    for (std::size_t c = 0; c < 36; ++c) {
      const double p = expected[c] / all;
      EXPECT_NEAR(counts[c] / count, p, 4.5 * std::sqrt(p * (1 - p) / count) + 0.02 * p) << c;
    }
  }
}

// Through column 6 of the first picture light of the only facet comes to column 8 of the second.
TEST(ThesisSampler, HasNoDrawWhereNoDirectionIsLitInAll) {
  const Layout layout = one_facet();
  std::mt19937_64 random(1);
  for (const Thesis::Sampling sampling : both) {
    Thesis settings{.sampling = sampling};
    EXPECT_TRUE(Sampler(layout, {{100, lit({6}), 0}, {200, lit({4}), 0}}, settings).draw(0, 3, random).slopes.empty());
    EXPECT_EQ(Sampler(layout, {{100, lit({6}), 0}, {200, lit({8}), 0}}, settings).draw(0, 3, random).slopes.size(), 3u);
    // Column 7 leads beside the second receiver: with overshoot that is allowed.
    EXPECT_TRUE(Sampler(layout, {{100, lit({7}), 0}, {200, lit({4}), 0}}, settings).draw(0, 3, random).slopes.empty());
    const Draws draws = Sampler(layout, {{100, lit({7}), 0}, {200, lit({4}), 0.1}}, settings).draw(0, 3, random);
    EXPECT_EQ(draws.cells, (std::vector<int>{4 * 9 + 7, -1, 4 * 9 + 7, -1, 4 * 9 + 7, -1}));
  }
}

TEST(ThesisPictures, Move) {
  const Layout layout = one_facet();
  EXPECT_EQ(moved(lit({3, 4}), layout, 1, {0, 0}), lit({3, 4}));
  EXPECT_EQ(moved(lit({3, 4}), layout, 1, {2.0 / 9, 0}), lit({5, 6}));
  // Cell 4 of half the size covers a quarter of itself; of three times the size, three by three cells.
  std::vector<double> half = moved(lit({2, 4}), layout, 0.5, {0, 0}); // cell 2 is then at 3.25 .. 3.75
  EXPECT_NEAR(half[4 * 9 + 4], 1, 1e-12);
  EXPECT_NEAR(half[4 * 9 + 3], 1, 1e-12);
  EXPECT_EQ(std::count_if(half.begin(), half.end(), [](double v) { return v > 0; }), 2);
  const std::vector<double> large = moved(lit({4}), layout, 3, {0, 0});
  EXPECT_NEAR(std::accumulate(large.begin(), large.end(), 0.0), 9, 1e-12);
  const std::vector<double> gone = moved(lit({0}), layout, 1, {-0.5, 0});
  EXPECT_EQ(std::accumulate(gone.begin(), gone.end(), 0.0), 0);
}

TEST(ThesisPictures, MarginIsTheDistanceToTheNearestLitCell) {
  Layout layout = one_facet();
  layout.cells = {11, 7};
  std::mt19937_64 random(3);
  std::vector<double> picture(77);
  for (double& value : picture) value = inverse::uniform(random) < 0.1 ? 1 : 0;
  const Margin margin = margin_of(picture, layout);
  for (int i = 0; i < 77; ++i) {
    double nearest = 1e9;
    for (int k = 0; k < 77; ++k)
      if (picture[static_cast<std::size_t>(k)] > 0)
        nearest = std::min(nearest, std::hypot(i % 11 - k % 11, i / 11 - k / 11));
    EXPECT_NEAR(margin.distance[static_cast<std::size_t>(i)], nearest, 1e-12) << i;
    EXPECT_GT(picture[margin.nearest[static_cast<std::size_t>(i)]], 0);
  }
}

// Two cells further, in thirds.
TEST(ThesisPictures, ExtendWithLinearlyLessLight) {
  const Layout layout = one_facet();
  std::vector<double> picture = lit({4});
  picture[4 * 9 + 4] = 0.6;
  const std::vector<double> made = extended(picture, margin_of(picture, layout), 2);
  EXPECT_NEAR(made[4 * 9 + 4], 0.6, 1e-12);
  EXPECT_NEAR(made[4 * 9 + 5], 0.4, 1e-12);
  EXPECT_NEAR(made[6 * 9 + 4], 0.2, 1e-12);
  EXPECT_EQ(made[4 * 9 + 7], 0);
  EXPECT_EQ(extended(picture, margin_of(picture, layout), 0), picture);
}

// As figure 5.12: the facet's light through column 4 + k of the first picture comes to column 4 + 2 k of the second.
TEST(ThesisPictures, MissingCellsNeedExtensionAndOvershoot) {
  const Layout layout = one_facet();
  const auto needs = [&](const std::vector<std::size_t>& first, const std::vector<std::size_t>& second) {
    const std::vector<SamplingTarget> aims{{100, lit(first), 0}, {200, lit(second), 0}};
    return needs_of(layout, aims, {margin_of(aims[0].picture, layout), margin_of(aims[1].picture, layout)});
  };
  std::vector<MissingLight> all = needs({4, 6}, {4});
  EXPECT_EQ(all[0].missing, 1u);
  EXPECT_EQ(all[1].missing, 0u);
  EXPECT_EQ(all[1].extension, 4); // from column 4 to column 8
  EXPECT_EQ(all[1].overshoot, 0);
  EXPECT_EQ(all[0].extension, 0);
  all = needs({4, 5, 7}, {4}); // column 5 comes to 6, column 7 to 10
  EXPECT_EQ(all[0].missing, 2u);
  EXPECT_EQ(all[1].extension, 2);
  EXPECT_EQ(all[1].overshoot, 0.5);
  all = needs({4}, {4});
  EXPECT_EQ(all[0].missing + all[1].missing, 0u);
  EXPECT_EQ(all[1].overshoot, 0); // 0 of 0
}

TEST(ThesisAnnealer, CoolsAndFindsTheLowest) {
  const auto cost = [](const std::vector<double>& v) { return (v[0] - 0.3) * (v[0] - 0.3) + (v[1] - 2) * (v[1] - 2); };
  const std::vector<AnnealedParameter> knobs{{0.9, 0.1, 0, 1}, {1, 0.1, 0.5, 1.2}}; // 2 is out of reach: 1.2
  Annealer annealer(knobs, {0.01, 0.5, 20, 20}, cost({0.9, 1}));
  EXPECT_EQ(annealer.temperature(), 0.01);
  for (std::uint64_t i = 0; !annealer.finished(); ++i) {
    const double before = annealer.lowest_cost(), there = cost(annealer.propose(inverse::numbers_of(1, i)));
    EXPECT_EQ(annealer.decide(there), there < before);
    if (i == 39) {
      EXPECT_EQ(annealer.temperature(), 0.0025);
    }
  }
  EXPECT_NEAR(annealer.lowest()[0], 0.3, 0.02);
  EXPECT_NEAR(annealer.lowest()[1], 1.2, 0.005);
  EXPECT_EQ(annealer.accepted() + annealer.refused(), 400);
}

// A rise by the temperature is taken with probability 1 / e; without temperature never.
TEST(ThesisAnnealer, TakesRisesAsTheTemperatureSays) {
  for (const double temperature : {0.1, 0.0}) {
    int taken = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      Annealer annealer({{}}, {temperature, 0.5, 1, 1}, 0.5);
      annealer.propose(inverse::numbers_of(2, i));
      annealer.decide(0.6);
      taken += annealer.accepted() == 1;
    }
    const double p = temperature > 0 ? std::exp(-1) : 0;
    EXPECT_NEAR(taken / 2000.0, p, 4 * std::sqrt(p * (1 - p) / 2000));
  }
}

} // namespace nephroid::thesis_test
