// SPDX-License-Identifier: Apache-2.0
// The thesis' pipeline as a whole: what its stages gain, that it ends, and that it goes on with the same bits.
#include "base/files.h"
#include "inverse/pictures/target.h"
#include "inverse/thesis/pipeline.h"
#include "tests/support/saved_jobs.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

using namespace nephroid;
using inverse::Layout;
using inverse::Picture;
using inverse::Pipeline;
using inverse::Target;
using inverse::Thesis;

class ThesisPipeline : public testing::Test {
protected:
  ThesisPipeline()
  {
    layout.facets = {32, 32}; // two pieces of work a trial
    layout.cells = {16, 16};
    layout.distances = {100, 200};
    settings.cycles = 3;
    settings.moves = 2;
    settings.corrections = 5;
    settings.directions = 48;
    Picture ring, disc;
    ring.type = Picture::Type::ring;
    const FileFinder finder;
    targets = {make_target(ring, layout, finder, "ring"), make_target(disc, layout, finder, "disc")};
  }

  static void finish(Pipeline& pipeline)
  {
    while (!pipeline.finished()) pipeline.advance();
  }
  static job::Snapshot shown(const Pipeline& pipeline)
  {
    job::Snapshot snapshot;
    pipeline.show(snapshot);
    return snapshot;
  }

  Layout layout;
  std::vector<Target> targets;
  Thesis settings;
};

TEST_F(ThesisPipeline, GainsInEveryStageAndEnds)
{
  settings.cycles = 5;
  for (const Thesis::Adjust adjust : {Thesis::Adjust::convergence, Thesis::Adjust::each}) {
    settings.adjust = adjust;
    Pipeline pipeline(layout, targets, settings, 1);
    finish(pipeline);
    EXPECT_LE(pipeline.steps(), pipeline.most());
    const job::Snapshot s = shown(pipeline);
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

TEST_F(ThesisPipeline, GoesOnWithTheSameBitsInEveryStage)
{
  for (const Thesis::Adjust adjust : {Thesis::Adjust::convergence, Thesis::Adjust::each}) {
    settings.adjust = adjust;
    Pipeline whole(layout, targets, settings, 7);
    std::vector<std::vector<std::byte>> cuts;
    for (int i = 0; !whole.finished(); ++i) {
      if (i % 3 == 1) cuts.push_back(test::saved<State>(whole)); // between trials and in the middle of one
      whole.advance();
    }
    cuts.push_back(test::saved<State>(whole));
    for (const auto& cut : cuts) {
      Pipeline other(layout, targets, settings, 7);
      ASSERT_TRUE(test::load<State>(other, cut));
      finish(other);
      ASSERT_EQ(other.slopes(), whole.slopes());
      ASSERT_EQ(other.light(0), whole.light(0));
      ASSERT_EQ(shown(other).curves.at(0).rows, shown(whole).curves.at(0).rows);
    }
    Pipeline seeded(layout, targets, settings, 8);
    finish(seeded);
    EXPECT_NE(seeded.slopes(), whole.slopes());
  }
}

// Light through the left edge of the first receiver never comes to the right edge of the second. Such facets are counted, nothing loops or
// becomes infinite, and the cost is the highest that there is.
TEST_F(ThesisPipeline, CountsFacetsWithoutADirection)
{
  targets.assign(2, Target(256));
  targets[0][8 * 16 + 0] = 1;
  targets[1][8 * 16 + 15] = 1;
  settings.sampling = Thesis::Sampling::rejection;
  settings.cycles = 0;
  Pipeline pipeline(layout, targets, settings, 1);
  finish(pipeline);
  const job::Snapshot s = shown(pipeline);
  EXPECT_EQ(job::scalar(s, "thesis", "dark_facets"), 1024);
  EXPECT_EQ(job::scalar(s, "thesis", "cost_correction"), 1);
  EXPECT_EQ(job::scalar(s, "thesis", "missing_cells_1"), 1);
  EXPECT_THAT(s.warnings.at(0), testing::HasSubstr("1024 facets can send light nowhere where all pictures are lit"));
  EXPECT_EQ(pipeline.slopes()[77], glm::dvec2(0));
  EXPECT_EQ(pipeline.steps(), 1 + settings.patience); // rounds without a gain
}

// With extension and overshoot the same facets find their way.
TEST_F(ThesisPipeline, ReachesMissingCellsBySecondAnnealing)
{
  targets.assign(2, Target(256));
  targets[0][8 * 16 + 0] = 1;
  targets[1][8 * 16 + 15] = 1;
  settings.size_limit = 0;
  Pipeline pipeline(layout, targets, settings, 1);
  finish(pipeline);
  const job::Snapshot s = shown(pipeline);
  EXPECT_LT(job::scalar(s, "thesis", "dark_facets"), 1024);
  EXPECT_EQ(job::scalar(s, "thesis", "gain_annealing_1"), 0);
  EXPECT_GT(job::scalar(s, "thesis", "gain_annealing_2"), 0.05);
}

} // namespace
