// SPDX-License-Identifier: Apache-2.0
// A run takes on other distances, weights and pictures and goes on from the slopes that it has.
#include "inverse/assign/footprint.h"
#include "inverse/engine.h"
#include "inverse/job.h"
#include "preset/read.h"
#include "tests/inverse/searches.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::going_on_test {

using namespace inverse;

/// The light of all facets, added up beside the search.
std::vector<double> light_of(const Layout& layout, const std::vector<glm::dvec2>& slopes, std::size_t receiver) {
  std::vector<double> light(layout.cell_count());
  for (std::size_t f = 0; f < slopes.size(); ++f) {
    for_cells(layout, inverse::footprint(layout, f, slopes[f], receiver),
              [&](std::size_t cell, double part) { light[cell] += inverse::facet_power(layout, f, slopes[f]) * part; });
  }
  return light;
}

// As if the sweeps had begun from those slopes: their light is that of the new distances, and a search that never knew
// the old ones goes on with the same bits.
TEST(GoingOn, IsAsBeginningFromThoseSlopes) {
  Layout layout = small_layout();
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 1);
  sweep(a, 2);
  for (int i = 0; i < 5; ++i) a.advance(); // in the middle of a sweep
  const std::vector<glm::dvec2> slopes = a.slopes();
  layout.distances = {90, 230};
  layout.weights = {{1, 3}};
  a.relight();
  EXPECT_EQ(a.slopes(), slopes);
  EXPECT_EQ(a.fraction_done(), 0);
  EXPECT_FALSE(a.finished());
  double residual = 0;
  for (const std::size_t j : {0u, 1u}) {
    const std::vector<double> light = light_of(layout, slopes, j);
    const double tone = std::accumulate(light.begin(), light.end(), 0.0), // as bright as its light lets it be
        most = *std::max_element(targets[j].begin(), targets[j].end()) * tone;
    for (std::size_t c = 0; c < light.size(); ++c) {
      EXPECT_NEAR(a.light(j)[c], light[c], 1e-4);
      residual += (*layout.weights)[j] / (most * most) * std::pow(light[c] - tone * targets[j][c], 2);
    }
  }
  EXPECT_NEAR(a.residual(), residual, 1e-5 * residual);
  Assignment b(test::shared_context(), layout, targets, 1);
  ASSERT_TRUE(test::load<Archive>(b, test::saved<Archive>(a)));
  sweep(a, 4);
  sweep(b, 4);
  EXPECT_EQ(a.slopes(), b.slopes());
}

TEST(GoingOn, AWeightBringsItsPictureForward) {
  Layout layout = small_layout(), heavy = small_layout();
  heavy.weights = {{20, 1}};
  const std::vector<Target> targets = ring_and_disc(layout);
  Assignment a(test::shared_context(), layout, targets, 1), b(test::shared_context(), heavy, targets, 1);
  sweep(a, 4);
  sweep(b, 4);
  EXPECT_LT(b.costs()[0].rel_l2, 0.8 * a.costs()[0].rel_l2);
  EXPECT_GT(b.costs()[1].rel_l2, a.costs()[1].rel_l2);
}

/// The shipped shapes with a quarter of their facets and cells.
preset::Preset shapes(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(),
                   {"inverse.facets=[64, 64]", "inverse.cells=[32, 32]", "scene.camera.resolution=[64, 64]"});
  return preset::read_preset("inverse/shapes", overrides);
}

std::unique_ptr<job::Job> job_of(const preset::Preset& preset) {
  return inverse::make_job(preset, inverse::make_plan(preset), test::shared_context());
}

void finish(job::Job& job) {
  while (!job.finished()) job.advance();
}

double cost(job::Job& job, const char* group) { return job::scalar(job.snapshot(), group, "cost"); }

/// What the search believes after a step: rel_l2.
double after_step(job::Job& job, std::int64_t step) {
  const job::Snapshot snapshot = job.snapshot();
  for (const std::vector<double>& row : snapshot.curves.at(0).rows)
    if (row[0] == static_cast<double>(step)) return row[4];
  return std::numeric_limits<double>::quiet_NaN();
}

// Which facets' light is misplaced is searched by steps, and only where somebody looks.
TEST(GoingOn, ASnapshotSearchesNoConflicts) {
  const auto job = job_of(shapes());
  const auto has_conflict = [&] {
    return std::ranges::count(job->snapshot().pictures, std::string("conflict"), &job::NamedPicture::name) == 1;
  };
  EXPECT_FALSE(has_conflict());
  while (job->progress().step == 0) job->advance();
  EXPECT_TRUE(has_conflict());
}

TEST(GoingOn, ADraggedDistanceIsNearerAfterASweepThanAFreshRun) {
  const preset::Preset before = shapes();
  preset::Preset now = before;
  inverse::settings(now).receivers[1].distance_mm = 158;
  ASSERT_TRUE(inverse::adoptable(before, now));
  const auto run = job_of(before), fresh = job_of(now);
  finish(*run);
  const std::int64_t sweeps = run->progress().step;
  ASSERT_TRUE(run->adopt(now));
  EXPECT_FALSE(run->finished());
  EXPECT_EQ(run->progress().step, sweeps);
  EXPECT_TRUE(std::isnan(cost(*run, "judged"))) << "what was judged was of the other distance";
  EXPECT_TRUE(run->snapshot().files.empty());
  finish(*run);
  finish(*fresh);
  EXPECT_LT(after_step(*run, sweeps + 1), after_step(*fresh, 1));
  EXPECT_LT(cost(*run, "judged"), 1.05 * cost(*fresh, "judged"));
}

TEST(GoingOn, TheStopCountsFromThere) {
  const preset::Preset before = shapes({"stop.passes=1"});
  preset::Preset now = before;
  inverse::settings(now).receivers[2].weight = 2;
  const auto run = job_of(before);
  finish(*run);
  ASSERT_TRUE(run->adopt(now));
  EXPECT_EQ(run->progress().steps, 2);
  finish(*run);
  EXPECT_EQ(run->progress().step, 2);
  now.stop.passes = 2; // more sweeps are asked for: it goes on
  ASSERT_TRUE(run->adopt(now));
  EXPECT_EQ(run->progress().steps, 4);
}

TEST(GoingOn, IsRefusedWhereFacetsOrReceiversAreOthers) {
  const preset::Preset before = shapes({"stop.passes=1"});
  const auto run = job_of(before);
  finish(*run);
  const auto refused = [&](const auto& change) {
    preset::Preset now = before;
    change(now, inverse::settings(now));
    EXPECT_FALSE(inverse::adoptable(before, now));
    EXPECT_FALSE(run->adopt(now));
  };
  refused([](auto&, inverse::Settings& s) { s.facets = {32, 32}; });
  refused([](auto&, inverse::Settings& s) { s.receivers.pop_back(); });
  refused([](auto&, inverse::Settings& s) { s.index.n = 1.6; });
  refused([](preset::Preset& p, auto&) { p.seed = 2; });
  preset::Preset turned = before;
  turned.scene.camera.position = {1, 2, 3};
  EXPECT_TRUE(run->adopt(turned));
  EXPECT_TRUE(run->finished()) << "another camera changes nothing";
  preset::Preset missing = before;
  inverse::settings(missing).receivers[0].picture.type = Picture::Type::file;
  inverse::settings(missing).receivers[0].picture.file = "there-is-none.png";
  EXPECT_THROW(run->adopt(missing), Error);
  EXPECT_TRUE(run->finished()) << "nothing has changed";
}

} // namespace nephroid::going_on_test
