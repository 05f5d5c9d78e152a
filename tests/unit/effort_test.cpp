// SPDX-License-Identifier: Apache-2.0
// How spectral.effort deals the photons of a pass to lights and clusters, and what a cluster's iterations are.
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/effort/importance.h"
#include "spectral/engine.h"
#include "spectral/tables/run_tables.h"
#include "tests/support/errors.h"
#include "tests/support/presets.h"

namespace nephroid::effort_test {

using spectral::RunTables;
using Effort = spectral::Settings::Effort;

constexpr unsigned photons = 1 << 16;

/// A dispersive ball over a floor under daylight and, three times as strong, a candle.
preset::Preset lit_ball(Effort effort)
{
  preset::Preset p = empty_preset();
  p.source = "p.json";
  spectral::settings(p).effort = effort;
  spectral::settings(p).photons_per_pass = photons;
  preset::Material dispersive = glass(1.5);
  dispersive.dispersion.type = preset::Dispersion::Type::cauchy;
  dispersive.dispersion.coefficients = {1.6, 0.02};
  p.scene.materials = {{"glass", dispersive}, {"floor", white(0.7)}};
  p.scene.objects = {object("ball", check::ball(0.5), "glass"), object("floor", quad(10, 10), "floor", at({0, -1, 0}))};
  preset::Light light;
  light.position = {0, 3, 0};
  p.scene.lights = {light, light};
  p.scene.lights[1].spectrum.illuminant = "A";
  p.scene.lights[1].power_w = 3;
  return p;
}

RunTables tables_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  return spectral::make_lit_tables(p, scene, scene::build_bvh(scene.geometry), {});
}

/// [light][cluster] photons of a pass.
std::vector<std::vector<double>> dealt(const RunTables& tables)
{
  std::vector<std::vector<double>> counts(tables.lights.size(), std::vector<double>(tables.wavelengths.clusters.size(), 0));
  for (const shared::DeviceEmitter& e : tables.emitters)
    counts[static_cast<std::size_t>(e.light)][static_cast<std::size_t>(e.cluster)] = e.photon_count;
  return counts;
}

/// What of a cluster's watts the second light has: both stand in one place, so only power and spectrum count.
double candle_part(const RunTables& tables, std::size_t cluster)
{
  const auto& share = tables.wavelengths.share;
  return 3 * share[1][cluster] / (share[0][cluster] + 3 * share[1][cluster]);
}

/// Photons of an emitter: one for each, and of the rest its part of all weights, rounded (deal_out).
double photons_for(double part, const RunTables& tables)
{
  const auto emitters = static_cast<double>(tables.emitters.size());
  return 1 + (photons - emitters) * part;
}

void expect_clusters_in_proportion(const RunTables& tables, const std::vector<double>& importance)
{
  const auto counts = dealt(tables);
  const double total = std::accumulate(importance.begin(), importance.end(), 0.0);
  for (std::size_t c = 0; c < importance.size(); ++c) {
    const double part = importance[c] / total, candle = candle_part(tables, c);
    EXPECT_NEAR(counts[0][c], photons_for(part * (1 - candle), tables), 1) << c;
    EXPECT_NEAR(counts[1][c], photons_for(part * candle, tables), 1) << c;
  }
  EXPECT_EQ(tables.photons_per_pass, photons);
}

TEST(DealtEffort, EqualGivesEveryClusterTheSame)
{
  const RunTables tables = tables_of(lit_ball(Effort::equal));
  ASSERT_GT(tables.wavelengths.clusters.size(), 5u);
  EXPECT_THAT(tables.importance, testing::Each(1));
  expect_clusters_in_proportion(tables, tables.importance);
}

TEST(DealtEffort, FollowsTheImportanceOfClusters)
{
  for (const Effort effort : {Effort::importance, Effort::radziszewski})
    for (const auto which : {spectral::Importance::Cluster::maximum, spectral::Importance::Cluster::mean}) {
      preset::Preset p = lit_ball(effort);
      spectral::settings(p).importance.cluster = which;
      const RunTables tables = tables_of(p);
      const scene::Scene scene = scene::load_scene(p);
      const optics::Spectrum u = spectral::wavelength_importance(spectral::settings(p), scene, scene::build_bvh(scene.geometry)).u;
      EXPECT_EQ(tables.importance, spectral::cluster_importance(u, tables.wavelengths.clusters, which));
      EXPECT_LT(*std::min_element(tables.importance.begin(), tables.importance.end()), 0.9);
      expect_clusters_in_proportion(tables, tables.importance);
    }
}

TEST(DealtEffort, OfPowerIsWhatTheEyeMakesOfIt)
{
  for (const Effort effort : {Effort::automatic, Effort::power, Effort::variance}) {
    const RunTables tables = tables_of(lit_ball(effort));
    const auto& w = tables.wavelengths;
    std::vector<double> weights;
    for (std::size_t l = 0; l < 2; ++l)
      for (std::size_t c = 0; c < w.clusters.size(); ++c) weights.push_back((l == 1 ? 3 : 1) * (w.seen[l][c] + 0.05 * w.share[l][c]));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto counts = dealt(tables);
    for (std::size_t i = 0; i < weights.size(); ++i)
      EXPECT_NEAR(counts[i / w.clusters.size()][i % w.clusters.size()], photons_for(weights[i] / total, tables), 1);
    EXPECT_EQ(*std::max_element(tables.importance.begin(), tables.importance.end()), 1);
    for (std::size_t c = 0; c < w.clusters.size(); ++c) // the iterations of sppm are in the same proportion
      EXPECT_NEAR(tables.importance[c] / tables.importance[0],
                  (weights[c] + weights[c + w.clusters.size()]) / (weights[0] + weights[w.clusters.size()]), 1e-9);
  }
}

// Importance is 0 where the floor reflects nothing, but light is there, and the nine points need not see all: no cluster is dropped.
TEST(DealtEffort, LeavesNoClusterWithLightOut)
{
  preset::Preset p = lit_ball(Effort::importance);
  preset::Reflectance& floor = p.scene.materials["floor"].reflectance;
  floor.type = preset::Reflectance::Type::table;
  floor.table = {{599, 0}, {600, 1}};
  const RunTables tables = tables_of(p);
  EXPECT_EQ(spectral::iterations(*std::min_element(tables.importance.begin(), tables.importance.end()), 2000), 1);
  EXPECT_EQ(tables.emitters.size(), 2 * tables.wavelengths.clusters.size());
}

// Where no caustic can be, nothing is asked of the surroundings; the plan leaves the photons out.
TEST(DealtEffort, IsNotAskedForWhereThereIsNoCaustic)
{
  preset::Preset p = lit_ball(Effort::importance);
  p.scene.objects.pop_back(); // the floor
  EXPECT_THAT(tables_of(p).importance, testing::Each(1));
  p = lit_ball(Effort::importance);
  p.scene.lights.clear();
  EXPECT_THAT(tables_of(p).importance, testing::Each(1));
  p = lit_ball(Effort::importance);
  p.scene.materials["floor"].reflectance.value = 0;
  EXPECT_THAT(refusal_of([&] { tables_of(p); }), testing::StartsWith("p.json#/spectral/effort: the importance (4.15) is 0 at every"));
}

TEST(DealtEffort, IsInThePlan)
{
  const auto reason_of = [](Effort effort, bool runs) {
    const preset::Preset p = lit_ball(effort);
    const scene::Scene scene = scene::load_scene(p);
    for (const plan::Pass& pass : spectral::make_plan(p, scene, scene::build_bvh(scene.geometry)).passes)
      if (pass.name == "importance") {
        EXPECT_EQ(pass.runs, runs);
        return pass.reason;
      }
    return std::string();
  };
  EXPECT_THAT(reason_of(Effort::importance, true), testing::MatchesRegex(".*surroundings \\(4.15\\): [0-9]+ % of the iterations.*"));
  EXPECT_THAT(reason_of(Effort::radziszewski, true), testing::HasSubstr("cosh"));
  EXPECT_THAT(reason_of(Effort::equal, false), testing::HasSubstr("spectral.effort is equal"));
  EXPECT_THAT(reason_of(Effort::power, false), testing::HasSubstr("what the eye makes of each cluster's light"));
  EXPECT_THAT(reason_of(Effort::automatic, false), testing::HasSubstr("while that gains enough"));
  EXPECT_THAT(reason_of(Effort::variance, false), testing::HasSubstr("variance that is measured"));
}

} // namespace nephroid::effort_test
