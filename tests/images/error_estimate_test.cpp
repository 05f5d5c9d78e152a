// SPDX-License-Identifier: Apache-2.0
// A run's own estimate of its error (measure/measured_job.h) against its true error, for every shipped preset and with
// few and many photons: eight independent runs of each, every one judged by the mean of the other seven.
#include "measure/measured_job.h"
#include "tests/support/test.h"

#include "preset/read.h"
#include "spectral/engine.h"
#include "tests/support/render.h"

#include <tuple>

namespace nephroid::error_estimate_test {

constexpr int runs = 8;

preset::Preset small(const std::string& name, int photons_per_pass, std::uint64_t seed) {
  preset::Preset p = preset::read_preset(name);
  // The light of the prism is a narrow strip: a smaller picture has a dozen pixels of it, too few for a mean.
  const int size = name == "spectral/prism" ? 96 : 40;
  p.scene.camera.resolution = {size, size};
  spectral::settings(p).photons_per_pass = photons_per_pass;
  spectral::settings(p).pixel_samples = 16;
  p.seed = seed;
  p.stop = {};
  p.stop.passes = 16;
  p.reference.reset();
  return p;
}

/// The last row of a run's history, and its picture.
struct Ended {
  std::vector<float> rgb;
  job::History history;
};

Ended run_measured(const preset::Preset& preset) {
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const photons::RunPlan plan = spectral::make_plan(preset, scene, bvh);
  const auto job =
      measure::measured(photons::make_job(preset, scene, bvh, plan, test::shared_context()), preset, nullptr);
  while (!job->finished()) job->advance();
  const job::Snapshot snapshot = job->snapshot();
  return {snapshot.picture->rgb, *snapshot.history};
}

std::vector<float> mean_but(const std::vector<Ended>& all, std::size_t left_out) {
  std::vector<float> mean(all[0].rgb.size(), 0.0f);
  for (std::size_t run = 0; run < all.size(); ++run)
    if (run != left_out)
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += all[run].rgb[i] / (static_cast<float>(all.size()) - 1);
  return mean;
}

class ErrorEstimate : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(ErrorEstimate, IsTheTrueErrorWithinAQuarter) {
  const auto& [name, photons] = GetParam();
  std::vector<Ended> ended;
  const auto [width, height] = small(name, photons, 0).scene.camera.resolution;
  for (int run = 0; run < runs; ++run)
    ended.push_back(run_measured(small(name, photons, 1000 + static_cast<std::uint64_t>(run))));
  for (const std::string metric : {"lab_mean", "lab_rms", "rel_l2"}) {
    double sum = 0, lowest = 1e9, highest = 0;
    for (std::size_t run = 0; run < ended.size(); ++run) {
      const std::vector<float> truth = mean_but(ended, run);
      const measure::Metrics against = measure::compare(
          {width, height, ended[run].rgb, "run"}, {width, height, truth, "the others"}, {}, measure::MetricSet::quick);
      // The others' mean has an error of its own, 1 / sqrt(7) of a run's: sqrt(1 + 1/7) of the true error is seen.
      const auto errors = measure::named(against);
      const auto found =
          std::find_if(errors.begin(), errors.end(), [&](const auto& error) { return error.first == metric; });
      const double error = found->second / std::sqrt(1 + 1.0 / (runs - 1));
      const double ratio =
          job::error_in(ended[run].history, ended[run].history.rows.back(), "estimated_" + metric) / error;
      sum += ratio / runs;
      lowest = std::min(lowest, ratio);
      highest = std::max(highest, ratio);
    }
    RecordProperty(metric + "_mean", std::to_string(sum));
    RecordProperty(metric + "_lowest", std::to_string(lowest));
    RecordProperty(metric + "_highest", std::to_string(highest));
    // A single run's ratio scatters by 3 to 10 %, because so small a picture is a mean of few pixels; that of eight by
    // a third of it.
    EXPECT_NEAR(sum, 1, 0.25) << metric << ": " << lowest << " to " << highest;
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, ErrorEstimate,
                         testing::Combine(testing::Values("first-light", "spectral/prism", "spectral/ball-lens",
                                                          "spectral/brilliant", "spectral/plate"),
                                          testing::Values(1 << 11, 1 << 13)),
                         [](const auto& parameters) {
                           const std::string preset = std::get<0>(parameters.param);
                           std::string name = preset.substr(preset.find('/') + 1) + "_" +
                                              std::to_string(std::get<1>(parameters.param));
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

} // namespace nephroid::error_estimate_test
