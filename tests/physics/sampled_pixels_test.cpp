// SPDX-License-Identifier: Apache-2.0
// Pixels that get samples from the eye by their noise: the mean is that of as many samples everywhere, and a run that
// is resumed has the bits of one that was not.
#include "photons/pixel_surfaces.h"
#include "preset/read.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"
#include "tests/support/statistics.h"
#include "tests/support/test.h"

#include <bit>

namespace nephroid::sampled_pixels_test {

constexpr int side = 20, runs = 160;

/// Glass before a bright and a dark ground, under a lamp with soft shadows and a sky: all kinds of pixels have noise.
preset::Preset ball(photons::Settings::Effort effort, int passes) {
  preset::Preset p = test::empty_preset(side);
  p.scene.materials = {{"glass", test::glass(1.6)}, {"floor", test::white(0.8)}};
  preset::Shape shape;
  shape.radius = 1;
  p.scene.objects = {test::object("ball", shape, "glass", test::at({0, 1.2, 0})),
                     test::object("floor", test::quad(6, 5), "floor")};
  preset::Light lamp;
  lamp.type = preset::Light::Type::area;
  lamp.position = {1, 4, 1.5};
  lamp.direction = {-1, -4, -1.5};
  lamp.size = {0.5, 0.5};
  lamp.power_w = 60;
  p.scene.lights = {lamp};
  p.scene.environment.emplace();
  p.scene.environment->type = preset::Environment::Type::constant;
  p.scene.environment->colour = {0.3, 0.5, 1};
  p.scene.environment->lights = false;
  p.scene.camera.position = {0, 5, 6};
  p.scene.camera.target = {0, 0.6, 0};
  p.scene.camera.fov_deg = 40;
  photons::Settings& settings = spectral::settings(p);
  settings.photons_per_pass = 1 << 12;
  settings.effort = effort;
  settings.direct = settings.background = true;
  p.stop = {};
  p.stop.passes = passes;
  return p;
}

/// Sums over runs of the luminance of each pixel, and of its square.
struct Sums {
  std::vector<double> sum = std::vector<double>(side * side), square = sum;
};

Sums render_many(preset::Preset preset, const char* layer, std::uint64_t first_seed) {
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const photons::RunPlan plan = spectral::make_plan(preset, scene, bvh);
  Sums sums;
  for (std::uint64_t run = 0; run < runs; ++run) {
    preset.seed = first_seed + run;
    const job::Snapshot shown = test::render(*photons::make_job(preset, scene, bvh, plan, test::shared_context()));
    const std::vector<float>& rgb = test::layer(shown, layer).rgb;
    for (std::size_t i = 0; i < sums.sum.size(); ++i) {
      const double y = 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
      sums.sum[i] += y;
      sums.square[i] += y * y;
    }
  }
  return sums;
}

class SampledPixels : public testing::TestWithParam<const char*> {};

TEST_P(SampledPixels, HaveTheMeanOfAsManySamplesEverywhere) {
  using Effort = photons::Settings::Effort;
  const Sums shared = render_many(ball(Effort::automatic, 9), GetParam(), 1),
             even = render_many(ball(Effort::power, 9), GetParam(), 1000);
  std::vector<bool> glass(side * side);
  for (const std::uint32_t pixel : photons::glass_pixels(scene::load_scene(ball(Effort::power, 1))))
    glass[pixel] = true;
  for (const bool of_glass : {true, false}) {
    double difference = 0, variance = 0, squares = 0, pixels = 0, gain = 0;
    for (std::size_t i = 0; i < glass.size(); ++i) {
      if (glass[i] != of_glass) continue;
      const auto variance_of = [&](const Sums& s) {
        return (s.square[i] - s.sum[i] * s.sum[i] / runs) / (runs - 1) / runs;
      };
      const double d = (shared.sum[i] - even.sum[i]) / runs, v = variance_of(shared) + variance_of(even);
      difference += d;
      variance += v;
      // What is so rare that a few events make all of a pixel's light: their variance says little.
      const auto is_rare = [&](const Sums& s) { return std::pow(s.sum[i] / runs, 2) < 16 * variance_of(s); };
      if (std::min(variance_of(shared), variance_of(even)) <= 1e-12 || is_rare(shared) || is_rare(even)) continue;
      squares += d * d / v;
      gain += std::log(std::max(variance_of(even), 1e-12) / std::max(variance_of(shared), 1e-12));
      ++pixels;
    }
    ASSERT_GT(pixels, 20);
    RecordProperty(of_glass ? "glass_gain" : "other_gain", std::to_string(std::exp(gain / pixels)));
    // The mean of pixels, and each on its own: a pixel's z^2 is 1 in the mean.
    EXPECT_GT(test::two_sided(difference / std::sqrt(variance)), test::false_alarm)
        << of_glass << ": " << difference / pixels;
    EXPECT_GT(test::chi_square_survival(squares, pixels), 1e-6) << of_glass << ": " << squares << " of " << pixels;
  }
}

INSTANTIATE_TEST_SUITE_P(Layers, SampledPixels, testing::Values("direct", "background"));

TEST(SampledPixelsResumed, HaveTheirBits) {
  const preset::Preset preset = ball(photons::Settings::Effort::automatic, 12);
  const auto whole = test::job_as_it_is(preset), stopped = test::job_as_it_is(preset),
             resumed = test::job_as_it_is(preset);
  for (int step = 0; step < 23; ++step)
    stopped->advance(); // after samples were shared out, and in the middle of a pass
  ASSERT_TRUE(test::load(*resumed, test::saved(*stopped)));
  EXPECT_EQ(test::render(*resumed).picture->rgb, test::render(*whole).picture->rgb);
}

} // namespace nephroid::sampled_pixels_test
