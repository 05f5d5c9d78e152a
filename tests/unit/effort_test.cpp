// SPDX-License-Identifier: Apache-2.0
// How the photons of a pass are allocated to lights and clusters: after spectral.effort, by measured variance, and as
// numbered emitters.
#include "photons/effort/emitters.h"
#include "spectral/settings.h"
#include "tests/support/plans.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::effort_test {

using photons::RunTables;
using Effort = photons::Settings::Effort;
using photons::NeymanAllocation;

constexpr unsigned photons = 1 << 16;

/// A dispersive ball over a floor under daylight and, three times as strong, a candle.
preset::Preset lit_ball(Effort effort) {
  preset::Preset p = empty_preset();
  p.source = "p.json";
  spectral::settings(p).effort = effort;
  spectral::settings(p).photons_per_pass = photons;
  preset::Material dispersive = glass(1.5);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.6, 0.02};
  p.scene.materials = {{"glass", dispersive}, {"floor", white(0.7)}};
  p.scene.objects = {object("ball", check::ball(0.5), "glass"), object("floor", quad(10, 10), "floor", at({0, -1, 0}))};
  preset::Light light{.position = {0, 3, 0}};
  p.scene.lights = {light, light};
  p.scene.lights[1].spectrum.illuminant = "A";
  p.scene.lights[1].power_w = 3;
  return p;
}

/// [light][cluster] photons of a round.
std::vector<std::vector<double>> allocated(const RunTables& tables) {
  std::vector<std::vector<double>> counts(tables.lights.size(),
                                          std::vector<double>(tables.wavelengths.clusters.size(), 0));
  for (const shared::DeviceEmitter& e : tables.emitters)
    counts[static_cast<std::size_t>(e.light)][static_cast<std::size_t>(e.cluster)] = e.photon_count;
  return counts;
}

/// What of a cluster's watts the second light has: both stand in one place, so only power and spectrum count.
double candle_part(const RunTables& tables, std::size_t cluster) {
  const auto& share = tables.wavelengths.share;
  return 3 * share[1][cluster] / (share[0][cluster] + 3 * share[1][cluster]);
}

/// Photons of an emitter: one for each, and of the rest its part of all weights, rounded (allocate_photons).
double photons_for(double part, const RunTables& tables) {
  const auto emitters = static_cast<double>(tables.emitters.size());
  return 1 + (tables.photons_per_batch - emitters) * part;
}

void expect_clusters_in_proportion(const RunTables& tables, const std::vector<double>& importance) {
  const auto counts = allocated(tables);
  const double total = std::accumulate(importance.begin(), importance.end(), 0.0);
  for (std::size_t c = 0; c < importance.size(); ++c) {
    const double part = importance[c] / total, candle = candle_part(tables, c);
    EXPECT_NEAR(counts[0][c], photons_for(part * (1 - candle), tables), 1) << c;
    EXPECT_NEAR(counts[1][c], photons_for(part * candle, tables), 1) << c;
  }
  EXPECT_EQ(tables.photons_per_pass(), photons);
}

TEST(AllocatedEffort, EqualGivesEveryClusterTheSame) {
  const RunTables tables = tables_of(lit_ball(Effort::equal));
  ASSERT_GT(tables.wavelengths.clusters.size(), 5u);
  EXPECT_THAT(tables.importance, Each(1));
  expect_clusters_in_proportion(tables, tables.importance);
}

TEST(AllocatedEffort, FollowsTheImportanceOfClusters) {
  for (const Effort effort : {Effort::importance, Effort::radziszewski})
    for (const auto which : {photons::Importance::Cluster::maximum, photons::Importance::Cluster::mean}) {
      preset::Preset p = lit_ball(effort);
      spectral::settings(p).importance.cluster = which;
      const RunTables tables = tables_of(p);
      EXPECT_EQ(tables.importance, photons::cluster_importance(importance_of(p).u, tables.wavelengths.clusters, which));
      EXPECT_LT(*std::min_element(tables.importance.begin(), tables.importance.end()), 0.9);
      expect_clusters_in_proportion(tables, tables.importance);
    }
}

TEST(AllocatedEffort, OfPowerIsWhatTheEyeMakesOfIt) {
  for (const Effort effort : {Effort::automatic, Effort::power, Effort::variance}) {
    const RunTables tables = tables_of(lit_ball(effort));
    const auto& w = tables.wavelengths;
    std::vector<double> weights;
    for (std::size_t l = 0; l < 2; ++l)
      for (std::size_t c = 0; c < w.clusters.size(); ++c)
        weights.push_back((l == 1 ? 3 : 1) * (w.seen[l][c] + 0.05 * w.share[l][c]));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto counts = allocated(tables);
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_NEAR(counts[i / w.clusters.size()][i % w.clusters.size()], photons_for(weights[i] / total, tables), 1);
    EXPECT_EQ(*std::max_element(tables.importance.begin(), tables.importance.end()), 1);
    for (std::size_t c = 0; c < w.clusters.size(); ++c) // the iterations of sppm are in the same proportion
      EXPECT_NEAR(tables.importance[c] / tables.importance[0],
                  (weights[c] + weights[c + w.clusters.size()]) / (weights[0] + weights[w.clusters.size()]), 1e-9);
  }
}

// Importance is 0 where the floor reflects nothing, but light is there, and the nine points need not see all: no
// cluster is dropped.
TEST(AllocatedEffort, LeavesNoClusterWithLightOut) {
  preset::Preset p = lit_ball(Effort::importance);
  preset::Reflectance& floor = p.scene.materials["floor"].reflectance;
  floor.type = preset::Reflectance::Type::table;
  floor.table = {{599, 0}, {600, 1}};
  const RunTables tables = tables_of(p);
  EXPECT_EQ(photons::iterations(*std::min_element(tables.importance.begin(), tables.importance.end()), 2000), 1);
  EXPECT_EQ(tables.emitters.size(), 2 * tables.wavelengths.clusters.size());
}

// Where no caustic can be, nothing is asked of the surroundings; the plan leaves the photons out.
TEST(AllocatedEffort, IsNotAskedForWhereThereIsNoCaustic) {
  preset::Preset p = lit_ball(Effort::importance);
  p.scene.objects.pop_back(); // the floor
  EXPECT_THAT(tables_of(p).importance, Each(1));
  p = lit_ball(Effort::importance);
  p.scene.lights.clear();
  EXPECT_THAT(tables_of(p).importance, Each(1));
  p = lit_ball(Effort::importance);
  p.scene.materials["floor"].reflectance.value = 0;
  EXPECT_THAT(refusal_of([&] { tables_of(p); }),
              StartsWith("p.json#/spectral/effort: the importance (4.15) is 0 at every"));
}

TEST(AllocatedEffort, IsInThePlan) {
  const auto reason_of = [](Effort effort, bool runs) {
    const plan::Plan plan = plan_of(lit_ball(effort));
    for (const plan::Decision& pass : plan.decisions)
      if (pass.name == "importance") {
        EXPECT_EQ(pass.runs, runs);
        return pass.reason;
      }
    return std::string();
  };
  EXPECT_THAT(reason_of(Effort::importance, true),
              testing::MatchesRegex(".*surroundings \\(4.15\\): [0-9]+ % of the iterations.*"));
  EXPECT_THAT(reason_of(Effort::radziszewski, true), HasSubstr("cosh"));
  EXPECT_THAT(reason_of(Effort::equal, false), HasSubstr("spectral.effort is equal"));
  EXPECT_THAT(reason_of(Effort::power, false), HasSubstr("what the eye makes of each cluster's light"));
  EXPECT_THAT(reason_of(Effort::automatic, false), HasSubstr("while that gains enough"));
  EXPECT_THAT(reason_of(Effort::variance, false), HasSubstr("variance that is measured"));
}

TEST(AllocatePhotons, GivesEveryEmitterItsShareAndNoneToTheDark) {
  EXPECT_THAT(photons::allocate_photons({1, 1, 2}, 8),
              ElementsAre(2, 3, 3)); // 1 each; then 5 by rounding the running sums 1.25, 2.5, 5
  EXPECT_THAT(photons::allocate_photons({1, 0, 1e-9}, 100), ElementsAre(99, 0, 1));
  EXPECT_THAT(photons::allocate_photons({1, 1, 1}, 1), ElementsAre(1, 1, 1));
  EXPECT_THAT(photons::allocate_photons({0, 0}, 10), ElementsAre(0, 0));
  std::vector<double> weights(401);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::pow(0.9, static_cast<double>(i));
  const std::vector<unsigned> counts = photons::allocate_photons(weights, 1 << 18);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 1u << 18);
}

// Two lights, three clusters; the second light has nothing in the middle one.
TEST(Emitters, AreNumberedAndThoseOfALightTogether) {
  const std::vector<shared::DeviceEmitter> emitters = photons::make_emitters(
      {{1, 0, 0, 0.5}, {1, 0, 1, 0.25}, {2, 0, 2, 0.25}, {3, 1, 0, 0.75}, {0, 1, 1, 0}, {3, 1, 2, 0.25}}, 1005);
  ASSERT_EQ(emitters.size(), 5u);
  EXPECT_EQ(photons::count_photons(emitters), 1005u);
  const unsigned counts[] = {101, 101, 201, 301, 301}; // 1 each, and 1000 as 1 : 1 : 2 : 3 : 3
  const int lights[] = {0, 0, 0, 1, 1}, clusters[] = {0, 1, 2, 0, 2};
  const float shares[] = {0.5f, 0.25f, 0.25f, 0.75f, 0.25f};
  unsigned first = 0;
  for (std::size_t e = 0; e < emitters.size(); ++e) {
    EXPECT_EQ(emitters[e].photon_count, counts[e]) << e;
    EXPECT_EQ(emitters[e].light, lights[e]) << e;
    EXPECT_EQ(emitters[e].cluster, clusters[e]) << e;
    EXPECT_EQ(emitters[e].share, shares[e]) << e;
    EXPECT_EQ(emitters[e].first_photon, first) << e;
    EXPECT_EQ(emitters[e].light_first_photon, lights[e] == 0 ? 0u : 403u) << e;
    EXPECT_EQ(emitters[e].light_photon_count, lights[e] == 0 ? 403u : 602u) << e;
    first += counts[e];
  }
}

TEST(Emitters, AreNoneInTheDark) {
  EXPECT_TRUE(photons::make_emitters({{0, 0, 0, 0}, {0, 1, 0, 0}}, 100).empty());
  EXPECT_TRUE(photons::make_emitters({}, 100).empty());
  EXPECT_EQ(photons::count_photons({}), 0u);
}

TEST(Emitters, SequencesAreLongerThan32Bits) {
  shared::DeviceEmitter emitter{.sequence_start = 0xfffffff0u};
  photons::advance_sequence(emitter, 0x20);
  EXPECT_EQ(emitter.sequence_start, 0x10u);
  EXPECT_EQ(emitter.sequence_start_high, 1u);
  photons::advance_sequence(emitter, std::uint64_t{5} << 32);
  EXPECT_EQ(emitter.sequence_start, 0x10u);
  EXPECT_EQ(emitter.sequence_start_high, 6u);
}

std::vector<shared::DeviceEmitter> emitters(const std::vector<unsigned>& counts) {
  std::vector<shared::DeviceEmitter> all;
  for (const unsigned count : counts) {
    shared::DeviceEmitter emitter{.photon_count = count};
    all.push_back(emitter);
  }
  photons::number_photons(all);
  return all;
}

TEST(NeymanAllocation, IsDueBeforePassesThatArePowersOfTwo) {
  NeymanAllocation allocation(emitters({10, 10}));
  std::vector<int> due;
  for (int pass = 0; pass < 70; ++pass) {
    if (!allocation.is_due(pass)) continue;
    due.push_back(pass);
    allocation.reallocate(pass, std::vector<std::int64_t>{1, 1}, 2);
  }
  EXPECT_EQ(due, (std::vector<int>{2, 4, 8, 16, 32, 64}));
}

// Two emitters with n = 100 photons each; a photon of the first adds v with v^2 = 9, of the second v^2 = 1. V_e = n *
// sum of v^2 a pass stand as 9 to 1, their roots as 3 to 1: 150 and 50 of the 200 photons; nine tenths of that and one
// of the first allocation, 145 and 55.
TEST(NeymanAllocation, GoesByTheRootOfTheVariance) {
  NeymanAllocation allocation(emitters({100, 100}));
  allocation.reallocate(2, std::vector<std::int64_t>{2 * 100 * 9, 2 * 100 * 1}, 2);
  EXPECT_NEAR(allocation.emitters()[0].photon_count, 145, 1);
  EXPECT_EQ(allocation.emitters()[0].photon_count + allocation.emitters()[1].photon_count, 200u);
  EXPECT_EQ(allocation.emitters()[1].first_photon, allocation.emitters()[0].photon_count);
  // What it measures from then on has other counts and the same variances: v goes as 1 / n. The allocation stays.
  const double a = allocation.emitters()[0].photon_count, b = allocation.emitters()[1].photon_count;
  allocation.reallocate(
      4, std::vector<std::int64_t>{std::llround(2 * a * 9 * 1e4 / (a * a)), std::llround(2 * b * 1e4 / (b * b))}, 2);
  EXPECT_NEAR(allocation.emitters()[0].photon_count, 145, 1);
}

TEST(NeymanAllocation, NobodyGoesWithoutAndNothingIsLost) {
  NeymanAllocation allocation(emitters({1, 1000, 7, 1}));
  allocation.reallocate(2, std::vector<std::int64_t>{0, std::int64_t{1} << 60, 0, 0}, 1);
  unsigned all = 0;
  for (const shared::DeviceEmitter& e : allocation.emitters()) {
    EXPECT_GE(e.photon_count, 1u);
    EXPECT_EQ(e.first_photon, all);
    all += e.photon_count;
  }
  EXPECT_EQ(all, 1009u);
  NeymanAllocation dark(emitters({30, 70}));
  dark.reallocate(2, std::vector<std::int64_t>{0, 0}, 2);
  EXPECT_EQ(dark.emitters()[0].photon_count, 30u);
}

// A light has one sequence for each half of the film: after 2 passes of 100 photons it has used 100 of each, after 4
// 200.
TEST(NeymanAllocation, SequencesGoOnWhereTheyWere) {
  NeymanAllocation allocation(emitters({40, 60}));
  allocation.reallocate(2, std::vector<std::int64_t>{1, 1}, 2);
  for (const shared::DeviceEmitter& e : allocation.emitters()) EXPECT_EQ(e.sequence_start, 100u);
  allocation.reallocate(4, std::vector<std::int64_t>{1, 1}, 2);
  for (const shared::DeviceEmitter& e : allocation.emitters()) EXPECT_EQ(e.sequence_start, 200u);
  NeymanAllocation whole(emitters({40, 60}));
  whole.reallocate(2, std::vector<std::int64_t>{1, 1}, 1);
  EXPECT_EQ(whole.emitters()[0].sequence_start, 200u);
}

// Sums of v^2 of two passes each: 2 * 900 as allocated first, then 2 * 300, then 2 * 450.
TEST(NeymanAllocation, KnowsWhatItHasGained) {
  NeymanAllocation allocation(emitters({40, 60}));
  EXPECT_EQ(allocation.gain(), 1);
  allocation.reallocate(2, std::vector<std::int64_t>{1000, 800}, 2);
  EXPECT_EQ(allocation.gain(), 1);
  allocation.reallocate(4, std::vector<std::int64_t>{500, 100}, 2);
  EXPECT_DOUBLE_EQ(allocation.gain(), 3);
  allocation.reallocate(8, std::vector<std::int64_t>{900, 900}, 2);
  EXPECT_DOUBLE_EQ(allocation.gain(), 2);
}

TEST(NeymanAllocation, CanGoBackToTheFirst) {
  NeymanAllocation allocation(emitters({40, 60}));
  allocation.reallocate(2, std::vector<std::int64_t>{1, 900}, 2);
  EXPECT_NE(allocation.emitters()[0].photon_count, 40u);
  allocation.restore_initial(4, 2);
  EXPECT_EQ(allocation.emitters()[0].photon_count, 40u);
  EXPECT_EQ(allocation.emitters()[1].photon_count, 60u);
  EXPECT_EQ(allocation.first_iteration(), 4);
  for (const shared::DeviceEmitter& e : allocation.emitters()) EXPECT_EQ(e.sequence_start, 200u);
}

TEST(NeymanAllocation, IsSavedWhole) {
  NeymanAllocation allocation(emitters({40, 60}));
  allocation.reallocate(2, std::vector<std::int64_t>{5, 700}, 2);
  const std::vector<std::byte> bytes = test::saved<tracing::Archive>(allocation);
  NeymanAllocation other(emitters({40, 60}));
  EXPECT_TRUE(test::load<tracing::Archive>(other, bytes));
  allocation.reallocate(4, std::vector<std::int64_t>{100, 3}, 2);
  other.reallocate(4, std::vector<std::int64_t>{100, 3}, 2);
  for (std::size_t e = 0; e < 2; ++e)
    EXPECT_EQ(other.emitters()[e].photon_count, allocation.emitters()[e].photon_count);
  EXPECT_EQ(other.gain(), allocation.gain());
}

} // namespace nephroid::effort_test
