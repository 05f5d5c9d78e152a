// SPDX-License-Identifier: Apache-2.0
// A stage of samples from the eye, as many as each pixel needs.
#pragma once
#include "photons/sampled_pixels.h"
#include "photons/stage.h"
#include "tracing/film.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace nephroid::photons {

/// What the plan of a stage adds to "64 samples a pixel".
inline const char* more_through_glass(const PlanInput& input) {
  return tracing::may_see_glass_or_mirror(input.scene) ? ", more where glass or a mirror is seen" : "";
}

class EyeStage : public Stage {
public:
  /// paths is the number of paths in a sample that meets no glass and no mirror first. A pixel may have at least
  /// least_enough of such samples.
  EyeStage(StageContext& world, const char* name, const char* layer, const Settings& settings, double paths = 1,
           int least_enough = 0)
      : world_(world), film_(world.zeroed(std::string("film ") + name, world.film_size())),
        preview_film_(world.preview_film()), pixels_(world, std::max(*settings.pixel_samples, least_enough), paths),
        name_(name), layer_(layer), enough_(static_cast<std::uint32_t>(*settings.pixel_samples)) {}

  const char* name() const override { return name_; }
  std::int64_t passes() const override { return pixels_.passes(); }
  double fraction_done() const override { return pixels_.fraction_done(); }
  bool samples_pixels() const override { return true; }
  double work() const override { return pixels_.work(); }
  void share_work(const Noise& noise) override { pixels_.share_work(noise); }

  bool advance(std::int64_t pass) override {
    return pixels_.advance(pass, [&](const compute::Buffer<shared::uint2>& samples, std::uint32_t count) {
      run(film_, false, world_.tables.camera, samples, count);
    });
  }

  void develop(std::int64_t, bool, job::Picture& picture) override {
    const auto samples = [&](std::size_t pixel) { return pixels_.samples(pixel); };
    tracing::add_layer(layer_, {world_.context.all_reduced_sum(film_), quanta_per_unit(), samples}, picture);
  }

  /// Takes one sample of each block in each half.
  bool advance_preview() override {
    const shared::DeviceCamera camera = world_.preview_camera();
    preview_film_ = world_.preview_film();
    std::vector<shared::uint2> samples;
    for (std::uint32_t block = 0; block < static_cast<std::uint32_t>(camera.width * camera.height); ++block)
      for (std::uint32_t half = 0; half < 2; ++half) samples.push_back({block, half});
    world_.context.communicator().keep_own_share(samples);
    run(preview_film_, true, camera, compute::Buffer(world_.context, "samples", samples),
        static_cast<std::uint32_t>(samples.size()));
    return true;
  }

  void develop_preview(job::Picture& picture) override {
    const auto samples = [](std::size_t) { return std::array{1.0, 1.0}; };
    tracing::add_layer(layer_, {world_.context.all_reduced_sum(preview_film_), quanta_per_unit(), samples}, picture);
  }

  void serialize(tracing::Archive& archive) override {
    pixels_.serialize(archive);
    archive.buffer(film_);
    if (archive.is_read()) preview_film_ = world_.preview_film();
    archive.buffer(preview_film_);
  }

protected:
  /// Runs the kernel with the stage's own arguments and `more`. is_preview: the camera has a pixel for each block.
  virtual void run(std::uint32_t count, bool is_preview, std::initializer_list<compute::Argument> more) = 0;
  /// Quanta of the film for a value of 1 on the device.
  virtual float film_scale() const { return world_.on_device(world_.tables.direct_scale); }
  /// The most quanta of each of a pixel's first pixel_samples contributions. All later ones cannot overflow the film.
  virtual double limit() const { return world_.tables.direct_limit; }
  /// The film's quanta for a value of 1 in the picture.
  virtual double quanta_per_unit() const { return world_.tables.direct_scale * world_.white; }

  StageContext& world_;
  compute::Buffer<std::int64_t> film_;
  compute::Buffer<std::int64_t> preview_film_; ///< film with a pixel for each block of the preview
  SampledPixels pixels_;

private:
  void run(const compute::Buffer<std::int64_t>& film, bool is_preview, const shared::DeviceCamera& camera,
           const compute::Buffer<shared::uint2>& samples, std::uint32_t count) {
    const shared::DeviceSampleLaunch launch{world_.seed, count, enough_, film_scale(), static_cast<float>(limit())};
    run(count, is_preview,
        {{"film", film}, {"energy", world_.energy}, {"camera", camera}, {"samples", samples}, {"launch", launch}});
  }

  const char *name_, *layer_;
  std::uint32_t enough_; ///< Settings::pixel_samples
};

} // namespace nephroid::photons
