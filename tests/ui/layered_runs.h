// SPDX-License-Identifier: Apache-2.0
// Fake runs whose pictures have two layers and whose pixels have a spectrum, for tests of what the View and the
// Inspector show.
#pragma once
#include "fake_job.h"
#include "job/job.h"
#include "optics/wavelength.h"
#include "spectral/settings.h"

namespace nephroid::test {

/// direct: (.25, .5, .125) everywhere. caustic: red grows to the right, green downwards. The picture is their sum.
class LayeredJob : public FakeJob, public job::SpectrumSource {
public:
  LayeredJob(const preset::Preset& preset, FakeSettings& runs)
      : FakeJob(preset, runs), relights_(spectral::settings(preset).relight),
        can_relight_(!spectral::settings(preset).indirect.value_or(false)), size_(preset.scene.camera.resolution) {}

  static std::array<float, 3> caustic(int x, int y) {
    return {static_cast<float>(x) / 64, static_cast<float>(y) / 48, 0};
  }

  job::Snapshot snapshot() override {
    job::Snapshot made = FakeJob::snapshot();
    auto picture = std::make_shared<job::Picture>();
    picture->width = size_[0];
    picture->height = size_[1];
    picture->layers = {{"direct", {}}, {"caustic", {}}};
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x) {
        const std::array<float, 3> direct{0.25f, 0.5f, 0.125f}, bent = caustic(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
          picture->layers[0].rgb.push_back(direct[c]);
          picture->layers[1].rgb.push_back(bent[c]);
          picture->rgb.push_back(direct[c] + bent[c]);
        }
      }
    made.picture = picture;
    return made;
  }

  /// Its radiance is the column in "direct" and the row in "caustic".
  std::shared_ptr<const job::PixelSpectrum> spectrum(const std::array<int, 2>& pixel) override {
    auto made = std::make_shared<job::PixelSpectrum>();
    made->pixel = pixel;
    if (!relights_) {
      made->why_not = "spectral.relight is false";
      if (can_relight_) made->remedy = "spectral.relight=true";
      return made;
    }
    made->layers = {{"direct", std::vector<double>(optics::wavelength_count, pixel[0])},
                    {"caustic", std::vector<double>(optics::wavelength_count, pixel[1])}};
    return made;
  }

private:
  bool relights_, can_relight_;
  std::array<int, 2> size_;
};

class LayeredRuns : public FakeRuns {
public:
  ui::NewRun make(const preset::Preset& preset, const Watch& watch) override {
    ui::NewRun run = FakeRuns::make(preset, watch);
    run.job = std::make_unique<LayeredJob>(preset, *this);
    return run;
  }
};

/// A reference of the fake runs' size and of one colour, with a layer "caustic" of another.
inline std::shared_ptr<measure::Reference> even_reference(std::array<float, 3> rgb, std::array<float, 3> caustic) {
  auto reference = std::make_shared<measure::Reference>();
  reference->width = 64;
  reference->height = 48;
  reference->origin = "reference.exr";
  reference->layers = {{"caustic", {}}};
  for (int i = 0; i < 64 * 48; ++i) {
    reference->rgb.insert(reference->rgb.end(), rgb.begin(), rgb.end());
    reference->layers[0].rgb.insert(reference->layers[0].rgb.end(), caustic.begin(), caustic.end());
  }
  return reference;
}

} // namespace nephroid::test
