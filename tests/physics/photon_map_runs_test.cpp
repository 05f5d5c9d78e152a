// SPDX-License-Identifier: Apache-2.0
// Runs with photon maps: the same bits however they are cut or resumed, iterations by importance, energy, and what the plan says.
#include "tests/support/closed_form.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::photon_map_runs_test {

using Estimator = spectral::Settings::Estimator;
using Effort = spectral::Settings::Effort;

/// A ball of dispersive glass that absorbs, and a mirror behind it, in view; two lamps.
preset::Preset glass_in_view(Estimator estimator, Effort effort = Effort::power)
{
  preset::Preset p = empty_preset(20);
  p.scene.materials = {{"floor", white(0.8)}, {"mirror", check::mirror(0.6)}, {"glass", glass(1.6)}};
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = "N-SF66";
  p.unit = preset::Preset::Unit::cm;
  p.scene.objects = {object("ball", check::ball(0.5), "glass", at({0, 0.7, 0})), object("floor", quad(8, 8), "floor"),
                     object("mirror", quad(3, 2), "mirror", at({0, 1, -1.2}, {90, 0, 0}))};
  preset::Light lamp;
  lamp.position = {1, 3, 1};
  lamp.power_w = 2;
  preset::Light second = lamp;
  second.position = {-1, 2, 1};
  second.spectrum.illuminant = "A";
  p.scene.lights = {lamp, second};
  p.scene.camera.position = {0, 1.5, 4};
  p.scene.camera.target = {0, 0.5, 0};
  spectral::settings(p).direct = true;
  spectral::settings(p).estimator = estimator;
  spectral::settings(p).effort = effort;
  spectral::settings(p).threshold_deg = 3;
  spectral::settings(p).photons_per_pass = 1 << 15;
  p.stop.passes = 3;
  return p;
}

struct Case {
  const char* name;
  Estimator estimator;
  Effort effort;
  bool jitter;
};

class MapRuns : public testing::TestWithParam<Case> {
protected:
  static preset::Preset preset()
  {
    preset::Preset p = glass_in_view(GetParam().estimator, GetParam().effort);
    spectral::settings(p).jitter = GetParam().jitter;
    spectral::settings(p).low_discrepancy = GetParam().jitter;
    return p;
  }
};

// Steps are cut by the clock, so two runs differ in that; and a run that is saved after any step and loaded elsewhere ends with the
// bits of one that never was.
TEST_P(MapRuns, ResumedAnywhereTheyEndWithTheSameBits)
{
  const preset::Preset p = preset();
  const scene::Scene scene = scene::load_scene(p);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const spectral::RunPlan plan = spectral::make_plan(p, scene, bvh);
  const auto make = [&] { return spectral::make_job(p, scene, bvh, plan, shared_context()); };
  const auto whole = make();
  while (!whole->finished()) whole->step();
  const job::Snapshot truth = whole->snapshot();

  auto job = make();
  int steps = 0;
  for (; !job->finished(); ++steps) {
    job->step();
    if (steps % 3 != 1) continue;
    const std::vector<std::byte> saved = test::saved(*job);
    const job::Snapshot before = job->snapshot();
    job = make();
    test::load(*job, saved);
    EXPECT_EQ(job->snapshot().picture->rgb, before.picture->rgb) << "at step " << steps;
  }
  EXPECT_GT(steps, 12);
  const job::Snapshot resumed = job->snapshot();
  EXPECT_EQ(resumed.picture->rgb, truth.picture->rgb);
  EXPECT_EQ(resumed.picture->error_draw, truth.picture->error_draw);
  EXPECT_EQ(spectral::energy_of(resumed).emitted_w, spectral::energy_of(truth).emitted_w);
  EXPECT_EQ(truth.picture->error_draw.empty(), GetParam().estimator == Estimator::sppm);
  EXPECT_GT(*std::max_element(truth.picture->rgb.begin(), truth.picture->rgb.end()), 0);
  EXPECT_THROW(test::load(*make(), std::vector<std::byte>(100)), Error);
}

// Whatever the estimator and however the clusters take turns: the same power leaves the lamps towards the ball and the mirror.
TEST_P(MapRuns, SendTheLampsPower)
{
  preset::Preset splat = glass_in_view(Estimator::splat);
  preset::Preset p = preset();
  spectral::settings(splat).direct = spectral::settings(p).direct = false;
  const spectral::EnergyBalance truth = spectral::energy_of(render(splat)), energy = spectral::energy_of(render(p));
  // The same spheres are aimed at, so every photon carries what is sent there, but for places where spheres overlap.
  EXPECT_NEAR((energy.deposited_w + energy.missed_w + energy.absorbed_w + energy.escaped_w + energy.lost_w) / energy.emitted_w, 1, 1e-6);
  EXPECT_EQ(energy.refused_contributions, 0u);
  if (GetParam().effort == Effort::random || GetParam().jitter) return; // what a pass stands for changes from pass to pass
  EXPECT_NEAR(energy.emitted_w / truth.emitted_w, 1, 0.03);
  EXPECT_NEAR(energy.deposited_w / truth.deposited_w, 1, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MapRuns,
                         testing::Values(Case{"automatic", Estimator::automatic, Effort::power, false},
                                         Case{"jittered", Estimator::automatic, Effort::power, true},
                                         Case{"sppm", Estimator::sppm, Effort::importance, false},
                                         Case{"random", Estimator::sppm, Effort::random, false}),
                         [](const auto& c) { return std::string(c.param.name); });

plan::Plan plan_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  return spectral::make_plan(p, scene, scene::build_bvh(scene.geometry));
}

plan::Pass pass_of(const plan::Plan& plan, const std::string& name)
{
  for (const plan::Pass& pass : plan.passes)
    if (pass.name == name) return pass;
  return {};
}

std::uint64_t bytes_of(const plan::Plan& plan, const std::string& name)
{
  for (const plan::PlannedBuffer& buffer : plan.buffers)
    if (buffer.name == name) return buffer.bytes;
  return 0;
}

TEST(MapPlan, SaysWhichEstimatorRunsAndWhy)
{
  const plan::Plan automatic = plan_of(glass_in_view(Estimator::automatic)), splat = plan_of(glass_in_view(Estimator::splat)),
                   sppm = plan_of(glass_in_view(Estimator::sppm));
  EXPECT_TRUE(pass_of(automatic, "photons").runs && pass_of(automatic, "photon maps").runs && pass_of(automatic, "error estimate").runs);
  EXPECT_TRUE(pass_of(splat, "photons").runs && !pass_of(splat, "photon maps").runs);
  EXPECT_THAT(pass_of(splat, "photon maps").reason, testing::HasSubstr("left out"));
  EXPECT_TRUE(!pass_of(sppm, "photons").runs && pass_of(sppm, "photon maps").runs && !pass_of(sppm, "error estimate").runs);
  preset::Preset away = glass_in_view(Estimator::automatic);
  away.scene.camera.target = {0, 1.5, 8};
  EXPECT_FALSE(pass_of(plan_of(away), "photon maps").runs);
  away.scene.camera.position = {0, 0.7, 0}; // inside the ball
  EXPECT_TRUE(pass_of(plan_of(away), "photon maps").runs);
}

TEST(MapPlan, SaysWhereARadiusLosesTheCaustics)
{
  // Pixels cover some 0.1 units, and the scene is 8 units across.
  const auto notes = [](double radius, Estimator estimator) {
    preset::Preset p = glass_in_view(estimator);
    spectral::settings(p).sppm.radius = radius;
    std::vector<std::string> all = plan_of(p).notes;
    std::erase_if(all, [](const std::string& note) { return !note.starts_with("spectral."); }); // N-SF66 starts at 390 nm
    return all;
  };
  for (const Estimator estimator : {Estimator::automatic, Estimator::sppm}) {
    EXPECT_THAT(notes(1e7, estimator), testing::ElementsAre(testing::AllOf(testing::StartsWith("spectral.sppm.radius: 10000000 units are "),
                                                                           testing::HasSubstr("blurred away"))));
    EXPECT_THAT(notes(1e-6, estimator), testing::ElementsAre(testing::AllOf(testing::StartsWith("spectral.sppm.radius: 1e-06 units are "),
                                                                            testing::HasSubstr("hardly a photon"))));
    for (const double usual : {0.03, 0.1, 0.5}) EXPECT_THAT(notes(usual, estimator), testing::IsEmpty()) << usual;
  }
  EXPECT_THAT(notes(1e7, Estimator::splat), testing::IsEmpty());
}

TEST(MapPlan, SppmTakesTwentyBytesForEachPixelInEachCluster)
{
  preset::Preset p = glass_in_view(Estimator::sppm);
  spectral::settings(p).method = spectral::Settings::Method::brute_force;
  EXPECT_EQ(bytes_of(plan_of(p), "statistics of pixels"), 401u * 400 * 20);
  spectral::settings(p).effort = Effort::random;
  EXPECT_EQ(bytes_of(plan_of(p), "statistics of pixels"), 400u * 20);
}

} // namespace nephroid::photon_map_runs_test
