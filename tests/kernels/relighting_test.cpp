// SPDX-License-Identifier: Apache-2.0
// Layers weighed by a light are the picture under that light: against runs without layers, in a scene with dispersion,
// several reflectors, an edge in most pixels' reach, glass before the camera and a dark lamp.
#include "photons/clusters/scene_clusters.h"
#include "spectral/settings.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/passes.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::relighting_test {

preset::LightSpectrum illuminant(const std::string& name) { return {.illuminant = name}; }

/// A ball of dispersing glass over a floor of coloured tiles, which the camera sees beside the ball and through it; two
/// lamps, the second of which is dark.
preset::Preset tiled_scene() {
  preset::Preset p = ball_scene();
  const char* patches[] = {"orange", "blue sky", "moderate red"};
  p.scene.objects.pop_back();
  for (int i = 0; i < 3; ++i) {
    preset::Material tile = white(1);
    tile.reflectance.type = preset::Reflectance::Type::patch;
    tile.reflectance.patch = patches[i];
    p.scene.materials[patches[i]] = tile;
  }
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 12; ++k)
      p.scene.objects.push_back(object(std::to_string(12 * i + k), quad(0.3, 0.3), patches[(i + 2 * k) % 3],
                                       at({0.3 * (i - 6) + 0.11, 0, 0.3 * (k - 6) + 0.07})));
  p.scene.lights[0].spectrum = illuminant("D65");
  preset::Light second = p.scene.lights[0];
  second.position = {-0.4, 2.3, 0.5};
  second.power_w = 0;
  p.scene.lights.push_back(second);
  spectral::settings(p).photons_per_pass = 1 << 13;
  p.stop.passes = 24;
  return p;
}

preset::Preset layered(preset::Preset p) {
  spectral::settings(p).relight = true;
  return p;
}

/// Means over blocks of 3 x 3 pixels of a layer, in three channels.
std::vector<double> blocks_of(const job::Snapshot& snapshot, const std::string& name) {
  const std::vector<float>& rgb = layer(snapshot, name).rgb;
  const int width = snapshot.picture->width, blocks = width / 3;
  std::vector<double> means(static_cast<std::size_t>(3 * blocks * blocks), 0);
  for (int y = 0; y < 3 * blocks; ++y)
    for (int x = 0; x < 3 * blocks; ++x)
      for (int c = 0; c < 3; ++c)
        means[static_cast<std::size_t>(3 * (y / 3 * blocks + x / 3) + c)] +=
            rgb[static_cast<std::size_t>(3 * (y * width + x) + c)] / 9.0;
  return means;
}

std::vector<double> both_layers(const job::Snapshot& snapshot) {
  std::vector<double> all = blocks_of(snapshot, "direct");
  const std::vector<double> caustic = blocks_of(snapshot, "caustic");
  all.insert(all.end(), caustic.begin(), caustic.end());
  return all;
}

double largest(const std::vector<Estimate>& estimates) {
  double most = 0;
  for (const Estimate& e : estimates) most = std::max(most, e.mean);
  return most;
}

/// Of a run whose passes go on under its own light; only the figures are of the other one.
std::vector<Estimate> relit_passes(const preset::Preset& own, const preset::Preset& other) {
  return step_passes(*job_of(own), [&](job::Job& job) {
    EXPECT_TRUE(job.adopt(other));
    const std::vector<double> figures = both_layers(job.snapshot());
    EXPECT_TRUE(job.adopt(own));
    return figures;
  });
}

/// The same without layers, by other random numbers.
preset::Preset fresh_run(preset::Preset p) {
  spectral::settings(p).relight = false;
  p.seed = 1000;
  return p;
}

/// The ball's glass bends all wavelengths alike and is from clear at 380 nm to exp(-9) over its radius at 780 nm.
preset::Preset dyed_scene(const fs::path& folder) {
  preset::Preset p = tiled_scene();
  const double k = 9 * 780e-9 / (4 * M_PI * p.scene.objects[0].shape->radius);
  std::ofstream(folder / "dye.yml")
      << "DATA:\n  - type: tabulated nk\n    data: |\n        0.38 1.5 0\n        0.78 1.5 " << k << "\n";
  preset::Material& material = p.scene.materials["glass"];
  material.dispersion = {};
  material.dispersion.type = preset::Dispersion::Type::file;
  material.dispersion.file = (folder / "dye.yml").string();
  material.absorption = true;
  return p;
}

TEST(Relighting, UnderItsOwnLightThePictureIsThatOfARunWithoutLayers) {
  preset::Preset plain = tiled_scene();
  plain.seed = 1000;
  const std::vector<Estimate> layers = render_passes(layered(tiled_scene()), both_layers),
                              without = render_passes(plain, both_layers);
  EXPECT_GT(largest(without), 0);
  EXPECT_GT(same_expectations(layers, without), false_alarm);
}

TEST(Relighting, UnderAnotherLightItIsThatOfARunWithThatLight) {
  // F10 has narrow lines where D65 is smooth; the dark lamp comes on, the white changes.
  preset::Preset other = layered(tiled_scene());
  other.scene.lights[0].spectrum = illuminant("F10");
  other.scene.lights[1].spectrum = illuminant("A");
  other.scene.lights[1].power_w = 20;
  other.white = 0.25;
  preset::Preset own = layered(tiled_scene());
  own.white = 1; // a run that has a white takes no preset without one
  const std::vector<Estimate> relit = relit_passes(own, other), truth = render_passes(fresh_run(other), both_layers);
  EXPECT_GT(same_expectations(relit, truth), false_alarm);

  // The test sees as little as one colour taken for another: the picture under the old light is not that.
  preset::Preset old = tiled_scene();
  old.scene.lights[1] = other.scene.lights[1];
  old.white = other.white;
  EXPECT_LT(same_expectations(render_passes(old, both_layers), truth), false_alarm);
}

TEST(Relighting, ThroughADyeItIsThatOfARunWithThatLight) {
  const TemporaryFolder folder;
  preset::Preset own = layered(dyed_scene(folder.path()));
  own.scene.camera.resolution = {12, 12};
  for (const double wavelength_nm : {0.0, 390.0, 420.0}) { // 0: a spectrum as smooth as the run's own
    preset::Preset other = own;
    other.scene.lights[0].spectrum = wavelength_nm > 0 ? line(wavelength_nm) : illuminant("A");
    preset::Preset clear = fresh_run(other);
    clear.scene.materials["glass"].absorption = false;
    const std::vector<Estimate> relit = relit_passes(own, other), truth = render_passes(fresh_run(other), both_layers),
                                undyed = render_passes(clear, both_layers);
    // Clusters promise that a line is not off by more than this share of what arrives without the dye, and smooth light
    // by far less.
    const double share = wavelength_nm > 0 ? photons::largest_loss_difference : 0.005;
    std::vector<double> bias;
    for (const Estimate& e : undyed) bias.push_back(share * std::abs(e.mean));
    EXPECT_GT(same_expectations(relit, truth, bias), false_alarm) << wavelength_nm;
    EXPECT_LT(same_expectations(undyed, truth, bias), false_alarm) << "the dye is seen";
  }
}

TEST(Relighting, TheRunGoesOnUnderTheNewLightAndItsEnergyIsThatLights) {
  preset::Preset other = layered(tiled_scene());
  other.scene.lights[0].spectrum = line(480);
  other.scene.lights[0].power_w = 1e6;
  other.scene.lights[1].power_w = 2e6;
  const auto job = job_of(layered(tiled_scene()));
  while (job->progress().step < 3) job->advance();
  ASSERT_TRUE(job->adopt(other));
  EXPECT_EQ(photons::energy_of(job->snapshot()).emitted_w, 0) << "nothing has been sent under the new light yet";
  while (!job->finished()) job->advance();
  preset::Preset fresh = other;
  spectral::settings(fresh).relight = false;
  const job::Snapshot relit = job->snapshot(), truth = render(fresh);
  const photons::EnergyBalance &e = photons::energy_of(relit), &t = photons::energy_of(truth);
  // Point lamps' photons differ little in power, and of 21 x 2^13 at least a tenth reach the floor through the ball: a
  // standard error of less than 1 %.
  EXPECT_NEAR(e.emitted_w / t.emitted_w, 1, 0.07);
  EXPECT_NEAR(e.deposited_w / t.deposited_w, 1, 0.07);
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-6 * e.emitted_w);
  EXPECT_EQ(e.refused_contributions, 0u);
}

TEST(Relighting, TheDrawOfTheErrorHasThePicturesScatter) {
  // Over many seeds, the mean of (picture - mean of pictures)^2 and of draw^2 are the same.
  preset::Preset p = layered(tiled_scene());
  p.stop.passes = 4;
  p.scene.camera.resolution = {12, 12};
  preset::Preset other = p;
  other.scene.lights[0].spectrum = illuminant("F10");
  constexpr int runs = 12;
  std::vector<std::vector<float>> pictures;
  double draws = 0;
  for (int i = 0; i < runs; ++i) {
    p.seed = other.seed = static_cast<std::uint64_t>(i) + 1;
    const auto job = job_of(p);
    while (job->progress().step < 2) job->advance();
    ASSERT_TRUE(job->adopt(other));
    const job::Snapshot snapshot = render(*job);
    ASSERT_FALSE(snapshot.picture->error_draw.empty());
    for (const float d : snapshot.picture->error_draw) draws += double(d) * d / runs;
    pictures.push_back(snapshot.picture->rgb);
  }
  double scatter = 0;
  for (std::size_t k = 0; k < pictures[0].size(); ++k) {
    double sum = 0, squares = 0;
    for (const auto& picture : pictures) sum += picture[k], squares += double(picture[k]) * picture[k];
    scatter += (squares - sum * sum / runs) / (runs - 1);
  }
  EXPECT_NEAR(std::log2(draws / scatter), 0, 1);
}

TEST(Relighting, ACheckpointGoesOnToTheSameBits) {
  const preset::Preset own = layered(tiled_scene());
  preset::Preset other = own;
  other.scene.lights[1].power_w = 5;
  const auto straight = job_of(own);
  while (straight->progress().step < 2) straight->advance();
  ASSERT_TRUE(straight->adopt(other));
  straight->advance();
  const std::vector<std::byte> saved = test::saved(*straight);
  const auto resumed = job_of(other);
  test::load(*resumed, saved);
  const job::Snapshot a = render(*straight), b = render(*resumed);
  EXPECT_EQ(a.picture->rgb, b.picture->rgb);
  EXPECT_EQ(photons::energy_of(a).emitted_w, photons::energy_of(b).emitted_w);
}

TEST(Relighting, OnlyTheLightIsAdopted) {
  const preset::Preset own = layered(tiled_scene());
  const auto job = job_of(own);
  preset::Preset moved = own, broken = own;
  moved.scene.lights[0].position[0] += 0.1;
  EXPECT_FALSE(job->adopt(moved));
  EXPECT_FALSE(job_of(tiled_scene())->adopt(tiled_scene())) << "without layers there is nothing to weigh";
  broken.scene.lights[0].spectrum.illuminant = "D66";
  EXPECT_THROW(job->adopt(broken), Error);
  while (job->progress().step < 1) job->advance();
  EXPECT_EQ(photons::energy_of(job->snapshot()).refused_contributions, 0u);
}

TEST(Relighting, ASceneThatShowsNothingCanBeAskedForLayers) {
  preset::Preset p = layered(ball_scene());
  p.scene.objects.pop_back(); // no diffuse surface
  p.stop.passes = 1;
  tracing::LeaveOut leave_out{.direct = false, .photons = false};
  const job::Snapshot snapshot = render(*specialised_job_of(p, leave_out));
  for (const float value : snapshot.picture->rgb) ASSERT_EQ(value, 0);
}

TEST(Relighting, ThePlanSaysWhatIsKeptAndTheMemory) {
  preset::Preset p = layered(tiled_scene());
  p.scene.camera.resolution = {128, 128};
  const photons::RunPlan plan = plan_of(p);
  const auto job = job_as_it_is(p);
  EXPECT_THAT(plan.decisions, Not(Contains(testing::Field(&plan::Decision::name, "dark lights")))) << "it is kept";
  EXPECT_THAT(plan.decisions, Contains(testing::Field(&plan::Decision::name, "relighting")));
  std::uint64_t films = 0;
  for (const plan::PlannedBuffer& b : plan.buffers)
    if (b.name.starts_with("film ")) films += b.bytes;
  EXPECT_LE(test::saved(*job).size(), 65536u) << "a film that nothing was added to takes no room";
  while (!job->finished()) job->advance();
  const std::size_t saved = test::saved(*job).size();
  EXPECT_LE(saved, films + 65536);
  EXPECT_GE(saved, films / 3) << "what is promised is not far above what is taken";
}

} // namespace nephroid::relighting_test
