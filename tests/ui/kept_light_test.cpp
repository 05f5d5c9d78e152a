// SPDX-License-Identifier: Apache-2.0
// What the window shows while the camera moves, on a real device: the light that has landed, on what is matt and was
// seen before, until the run has its own.
#include "fake_job.h"
#include "spectral/settings.h"
#include "ui/state/device_runs.h"

namespace nephroid::ui::kept_light_test {

constexpr const char* scene = R"({
  "engine": "spectral", "white": 1, "stop": {"passes": 24}, "spectral": {"smoothing": "off", "photons_per_pass": 16384},
  "scene": {
    "camera": {"position": [0, 3, 4], "target": [0, 0, 0], "resolution": [48, 48]},
    "materials": {"wood": {"type": "diffuse"}, "glass": {"type": "dielectric", "dispersion": 1.5}},
    "objects": [
      {"name": "floor", "shape": {"type": "quad", "size": [6, 1, 6]}, "material": "wood"},
      {"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "material": "glass",
       "transform": {"translate": [0, 0.6, 0]}}],
    "lights": [{"type": "point", "position": [1, 3, 0.5], "power_w": 100}]}})";

class KeptLightTest : public testing::Test {
protected:
  /// The run after so many slices; all of them without a number.
  job::Snapshot run(const preset::Preset& preset, DeviceRuns& by, std::optional<int> slices = {}) {
    job_ = by.make(preset, {}).job;
    for (int i = 0; i != slices.value_or(-1) && !job_->finished(); ++i) job_->advance();
    return job_->snapshot();
  }
  /// How far a picture is from the truth on the floor, root mean square over what is given.
  static double error(const job::Picture& picture, const job::Picture& truth, const std::vector<bool>& where) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
      if (where[i / 3]) sum += std::pow(picture.rgb[i] - truth.rgb[i], 2), ++count;
    return std::sqrt(sum / count);
  }
  DeviceRuns runs{{}};
  std::unique_ptr<job::Job> job_;
};

TEST_F(KeptLightTest, StaysWhileTheCameraMovesAndIsOfNoOtherScene) {
  preset::Preset preset = preset::parse_preset(scene, "p.json");
  EXPECT_EQ(run(preset, runs).in_view, nullptr);
  preset.scene.camera.position = {0.3, 3, 4};
  const job::Snapshot first = run(preset, runs, 1);
  ASSERT_NE(first.in_view, nullptr);
  EXPECT_THAT(first.caption, HasSubstr("before the camera moved"));
  DeviceRuns others({});
  EXPECT_EQ(run(preset, others, 1).picture->rgb, first.picture->rgb) << "the run's own picture is its own";
  const job::Snapshot whole = run(preset, others);
  EXPECT_EQ(whole.in_view, nullptr);
  std::vector<bool> floor(48 * 48);
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const double x = static_cast<double>(i % 48) - 23.5, y = static_cast<double>(i / 48) - 23.5;
    floor[i] = std::hypot(x, y) > 14 && std::hypot(x, y) < 20; // neither the ball nor the floor's edge
  }
  EXPECT_LT(error(*first.in_view, *whole.picture, floor), 0.3 * error(*first.picture, *whole.picture, floor));

  // The camera goes on before the run has a picture of its own: what is kept is of the first.
  preset.scene.camera.position = {0.6, 3, 4};
  EXPECT_NE(run(preset, runs, 1).in_view, nullptr);
  preset.scene.camera.position = {0.7, 3, 4};
  EXPECT_EQ(run(preset, runs).in_view, nullptr) << "a finished run shows its own";

  preset.scene.camera.position = {0.7, -3, 4}; // the floor from below is dark
  EXPECT_EQ(run(preset, runs, 1).in_view, nullptr);

  preset.scene.camera.aperture = 0.1;
  EXPECT_EQ(run(preset, runs, 1).in_view, nullptr) << "a lens blurs";
  preset.scene.camera.aperture = 0;
  preset.scene.lights[0].power_w *= 2;
  EXPECT_EQ(run(preset, runs, 1).in_view, nullptr) << "another light";
  run(preset, runs);
  EXPECT_EQ(run(preset, runs, 1).in_view, nullptr) << "begun anew";
}

// A job that has taken on another light shows that, and lends nothing to the run of another camera.
TEST_F(KeptLightTest, IsNotOfAnotherLightThatAJobTookOn) {
  preset::Preset preset = preset::parse_preset(scene, "p.json");
  spectral::settings(preset).relight = true;
  run(preset, runs);
  preset.scene.lights[0].power_w *= 2;
  ASSERT_TRUE(job_->adopt(preset));
  job_->snapshot();
  preset.scene.camera.position = {0.3, 3, 4};
  EXPECT_EQ(run(preset, runs, 1).in_view, nullptr);
}

} // namespace nephroid::ui::kept_light_test
