// SPDX-License-Identifier: Apache-2.0
// A run's own estimate of its error (measure/measured_job.h) against its true error, for every shipped preset and with
// few and many photons: four independent runs of each, judged by a long one that is not smoothed.
#include "measure/measured_job.h"
#include "tests/support/test.h"

#include "preset/read.h"
#include "spectral/engine.h"
#include "tests/support/render.h"

#include <map>
#include <tuple>

namespace nephroid::error_estimate_test {

constexpr int runs = 4;

preset::Preset small(const std::string& name, int photons_per_pass, std::uint64_t seed) {
  preset::Preset p = preset::read_preset(name);
  // The light of the prism is a narrow strip: a smaller picture has a dozen pixels of it, too few for a mean.
  const int size = name == "spectral/prism" ? 96 : 40;
  p.scene.camera.resolution = {size, size};
  spectral::settings(p).estimator = photons::Settings::Estimator::points; // of tiles: physics/tiles_test.cpp
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

/// The picture of a run of so much light that its own error does not count.
const std::vector<float>& truth_of(const std::string& name) {
  static std::map<std::string, std::vector<float>> truths;
  std::vector<float>& truth = truths[name];
  if (truth.empty()) {
    preset::Preset p = small(name, 1 << 17, 1);
    spectral::settings(p).smoothing = photons::Settings::Smoothing::off;
    spectral::settings(p).pixel_samples = 512;
    p.stop.passes = 32;
    truth = run_measured(p).rgb;
  }
  return truth;
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
      const measure::Metrics against =
          measure::compare({width, height, ended[run].rgb, "run"}, {width, height, truth_of(name), "long run"}, {},
                           measure::MetricSet::quick);
      const auto errors = measure::named(against);
      const auto found =
          std::find_if(errors.begin(), errors.end(), [&](const auto& error) { return error.first == metric; });
      const double error = found->second;
      const double ratio =
          job::error_in(ended[run].history, ended[run].history.rows.back(), "estimated_" + metric) / error;
      sum += ratio / runs;
      lowest = std::min(lowest, ratio);
      highest = std::max(highest, ratio);
    }
    RecordProperty(metric + "_mean", std::to_string(sum));
    RecordProperty(metric + "_lowest", std::to_string(lowest));
    RecordProperty(metric + "_highest", std::to_string(highest));
    // A single run's ratio scatters by 3 to 10 %, because so small a picture is a mean of few pixels; that of four by
    // half of it.
    // Most pixels of the prism have no photon yet: there the estimate of CIELAB is a guess
    // (docs/notebook/smoothing.md).
    if (name == "spectral/prism" && metric != "rel_l2") continue;
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
