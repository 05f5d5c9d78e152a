// SPDX-License-Identifier: Apache-2.0
// What the camera sees through glass gets samples as long as a run goes on, and its share of the work by what that gains; other pixels end
// at spectral.pixel_samples.
#include "spectral/sampled_pixels.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"
#include "tests/support/test.h"

namespace nephroid::glass_goes_on_test {

/// A ball of glass that dispersion pulls apart, before a sky of one colour; the floor under it, half of the picture, is seen directly.
preset::Preset ball(int passes, std::uint64_t seed = 1)
{
  preset::Preset p = test::ball_scene();
  p.seed = seed;
  p.scene.environment = preset::Environment{preset::Environment::Type::constant, "", {0.2, 0.5, 1}};
  p.scene.camera.resolution = {48, 48};
  spectral::settings(p).pixel_samples = 4;
  spectral::settings(p).caustic = false;
  p.stop.passes = passes;
  return p;
}

struct Errors {
  double glass = 0, elsewhere = 0; ///< sums of squares
};

Errors errors_of(const std::vector<float>& rgb, const std::vector<float>& truth, const std::vector<bool>& glass)
{
  Errors errors;
  for (std::size_t i = 0; i < rgb.size(); ++i)
    (glass[i / 3] ? errors.glass : errors.elsewhere) += std::pow(static_cast<double>(rgb[i]) - truth[i], 2);
  return errors;
}

TEST(ThroughGlass, RunsGoOnConverging)
{
  std::vector<bool> glass(48 * 48, false);
  for (const std::uint32_t pixel : spectral::glass_pixels(scene::load_scene(ball(1)))) glass[pixel] = true;
  const job::Snapshot few = test::render(ball(4)), many = test::render(ball(64));
  preset::Preset long_run = ball(1024, 1000);
  spectral::settings(long_run).pixel_samples = 1024;
  const job::Snapshot truth = test::render(long_run);
  for (const char* name : {"direct", "background"}) {
    const Errors before = errors_of(layer(few, name).rgb, layer(truth, name).rgb, glass),
                 after = errors_of(layer(many, name).rgb, layer(truth, name).rgb, glass);
    // 16 times as many samples: a sixteenth of the variance, and a half more for few pixels with many of it.
    EXPECT_GT(before.glass, 0) << name;
    EXPECT_LT(after.glass, 1.5 / 16 * before.glass) << name;
    EXPECT_EQ(after.elsewhere, before.elsewhere) << name;
  }
  // The run's own estimate knows: the squares of its draw are those of the error.
  std::vector<float> draw = many.picture->error_draw;
  const Errors drawn = errors_of(draw, std::vector<float>(draw.size(), 0.0f), glass),
               error = errors_of(many.picture->rgb, truth.picture->rgb, glass);
  EXPECT_NEAR(drawn.glass / error.glass, 1, 0.3);
}

/// The same with caustics, photon maps and all that a run decides by what it measures.
preset::Preset whole(int passes)
{
  preset::Preset p = ball(passes);
  spectral::settings(p).caustic = true;
  spectral::settings(p).estimator = spectral::Settings::Estimator::automatic;
  spectral::settings(p).effort = spectral::Settings::Effort::automatic;
  spectral::settings(p).smoothing = spectral::Settings::Smoothing::automatic;
  spectral::settings(p).photons_per_pass = 1 << 12;
  return p;
}

TEST(ThroughGlass, ARunThatIsResumedHasTheSameBits)
{
  const job::Snapshot straight = test::render_as_it_is(whole(20));
  for (const int steps : {1, 17, 40}) { // somewhere in passes before and after what is measured has changed anything
    const auto first = test::job_as_it_is(whole(20));
    for (int step = 0; step < steps && !first->finished(); ++step) first->step();
    const std::vector<std::byte> state = test::saved(*first);
    const auto second = test::job_as_it_is(whole(20));
    EXPECT_TRUE(test::load(*second, state));
    while (!second->finished()) second->step();
    const job::Snapshot resumed = second->snapshot();
    EXPECT_EQ(resumed.picture->rgb, straight.picture->rgb) << steps;
    EXPECT_EQ(resumed.picture->error_draw, straight.picture->error_draw) << steps;
  }
}

/// The sum of the caustic that the ball shows, over passes: the number of paths a pass changes, what they show does not.
TEST(ThroughGlass, SharesChangeNoLight)
{
  preset::Preset shared = whole(64), plain = test::plain(shared);
  spectral::settings(shared).smoothing = spectral::Settings::Smoothing::off;
  plain.seed = 7;
  std::vector<bool> glass(48 * 48, false);
  for (const std::uint32_t pixel : spectral::glass_pixels(scene::load_scene(plain))) glass[pixel] = true;
  const auto sum_of = [&](const job::Snapshot& snapshot) {
    const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) sum += glass[i / 3] ? rgb[i] : 0;
    return sum;
  };
  const double by_gain = sum_of(test::render_as_it_is(shared)), as_before = sum_of(test::render(plain));
  EXPECT_GT(as_before, 0);
  EXPECT_NEAR(by_gain / as_before, 1, 0.05);
}

} // namespace nephroid::glass_goes_on_test
