// SPDX-License-Identifier: Apache-2.0
// What a run shows before its first pass is done: whole pictures, each better than the one before.
#include "measure/metrics.h"
#include "spectral/engine.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/render.h"

namespace nephroid::previews_test {

constexpr int size = 192;

/// A ball of glass over a floor, which shows its caustic directly and through the ball.
preset::Preset seen_through_glass() {
  preset::Preset p = test::ball_over_floor();
  p.scene.camera.position = {0, 1, 4};
  p.scene.camera.target = {0, -0.5, 0};
  p.scene.camera.resolution = {size, size};
  p.scene.lights[0].position = {1, 3, 1};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.stop.passes = 2;
  return p;
}

double error_of(const job::Picture& picture, const job::Picture& truth) {
  return measure::compare({picture.width, picture.height, picture.rgb, "picture"}, {size, size, truth.rgb, "truth"})
      .rel_l2;
}

TEST(Previews, AreWholeAndGetBetter) {
  preset::Preset p = seen_through_glass(), long_run = p;
  long_run.stop.passes = 36;
  long_run.seed = 77;
  spectral::settings(long_run).smoothing = photons::Settings::Smoothing::off;
  const job::Snapshot truth = test::render_as_it_is(long_run);
  const auto job = test::job_as_it_is(p);
  std::vector<double> errors;
  for (int look = 0; look < 2; ++look) {
    job->advance();
    const job::Snapshot first = job->snapshot();
    EXPECT_TRUE(first.progress.whole);
    EXPECT_EQ(first.progress.step, 0);
    EXPECT_LT(first.progress.work, 60'000u) << "of 262,144 photons";
    errors.push_back(error_of(*first.picture, *truth.picture));
  }
  while (job->progress().step < 1) job->advance();
  errors.push_back(error_of(*job->snapshot().picture, *truth.picture));
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]) << i;
  EXPECT_LT(errors[0], 0.6);
  RecordProperty("rel_l2 of both first pictures, and of one pass", testing::PrintToString(errors));
}

// A path sees one of three lamps at a time, each of its colour: one path a pixel is confetti. The preview stays until
// the second pass.
TEST(Previews, StayWhereOnePathOfAPixelShowsLittle) {
  preset::Preset p = seen_through_glass();
  p.scene.lights.clear();
  p.scene.environment =
      preset::Environment{.file = NEPHROID_SOURCE_DIR "/presets/spectral/three-lamps.hdr", .lights = true};
  const auto job = test::job_as_it_is(p);
  while (job->progress().step < 1) job->advance();
  const job::Picture picture = *job->snapshot().picture;
  preset::Preset without_previews = p;
  without_previews.stop.passes = 1;
  const job::Snapshot confetti = test::render_as_it_is(without_previews);
  // The means of neighbours' differences over the picture's light, in its lower half: the floor.
  const auto noise_of = [](const job::Picture& of) {
    double differences = 0, light = 0;
    for (std::size_t c = of.rgb.size() / 2; c + 3 < of.rgb.size(); ++c)
      differences += std::abs(of.rgb[c + 3] - of.rgb[c]), light += of.rgb[c];
    return differences / light;
  };
  EXPECT_LT(noise_of(picture), 0.2 * noise_of(*confetti.picture));
}

// Where the camera sees the sky alone, there is nothing but that; where photons_per_pass is small, no round of photons
// is to spare.
TEST(Previews, ARunMayHaveNoPhotonsForThem) {
  preset::Preset p = seen_through_glass();
  spectral::settings(p).estimator = photons::Settings::Estimator::points;
  spectral::settings(p).photons_per_pass = 1024;
  const auto job = test::job_as_it_is(p);
  job->advance();
  EXPECT_TRUE(job->snapshot().progress.whole);
  EXPECT_EQ(job->progress().work, 0u);
}

} // namespace nephroid::previews_test
