// SPDX-License-Identifier: Apache-2.0
// A stage with one sample a pixel and pass from the eye, into a film of its own: the layers "direct" and "background".
#pragma once
#include "photons/sampled_pixels.h"
#include "photons/stage.h"
#include "tracing/film.h"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace nephroid::photons {

/// For the plan: what a stage adds to "64 samples a pixel".
inline const char* more_through_glass(const PlanInput& input)
{
  return tracing::may_see_glass_or_mirror(input.scene) ? ", more where glass or a mirror is seen" : "";
}

class EyeStage : public Stage {
public:
  EyeStage(DeviceWorld& world, const char* layer, const Settings& settings)
      : world_(world), layer_(layer), pixel_samples_(settings.pixel_samples),
        film_(world.zeroed(std::string("film ") + layer, world.film_size())), first_film_(world.first_film()),
        pixels_(world, settings.pixel_samples)
  {
  }

  const char* name() const override { return layer_; }
  std::int64_t passes() const override { return pixels_.passes(); }
  double part() const override { return pixels_.part(); }
  double glass_work() const override
  {
    return paths_through_glass * work_of_a_path * static_cast<double>(pixels_.glass()) / static_cast<double>(pixels_.every());
  }
  void share_work(double factor) override { pixels_.sample_one_pass_in(static_cast<double>(pixels_.every()) / factor); }

  /// Glass, which is sampled as long as the run goes on, may have no contribution with more quanta than any number of them can.
  bool step(std::int64_t pass) override
  {
    const double most = pass < pixel_samples_ ? limit() : std::min(limit(), tracing::film_limit);
    return pixels_.step(pass, [&](std::uint32_t first, std::uint32_t count) {
      run(film_, world_.tables.camera, static_cast<std::uint32_t>(pass), first, count, most);
    });
  }

  void develop(std::int64_t, bool, job::Picture& picture) override
  {
    tracing::add_layer(layer_, {film_.read(), quanta_per_unit(), [&](std::size_t pixel) { return pixels_.samples(pixel); }}, picture);
  }

  /// One sample of each block in each half.
  bool look() override
  {
    const shared::DeviceCamera camera = world_.first_camera();
    first_film_ = world_.first_film();
    for (std::uint32_t half = 0; half < 2; ++half)
      run(first_film_, camera, half, 0, static_cast<std::uint32_t>(camera.width * camera.height), limit());
    return true;
  }

  void develop_first(job::Picture& picture) override
  {
    tracing::add_layer(layer_, {first_film_.read(), quanta_per_unit(), [](std::size_t) { return std::array{1.0, 1.0}; }}, picture);
  }

  void state(tracing::State& state) override
  {
    pixels_.state(state);
    state.buffer(film_);
    if (state.is_read()) first_film_ = world_.first_film();
    state.buffer(first_film_);
  }

protected:
  /// Runs the kernel with its own arguments and `more`.
  virtual void run(std::uint32_t count, std::initializer_list<compute::Argument> more) = 0;
  /// Quanta that one contribution may have while all pixels are sampled.
  virtual double limit() const = 0;
  /// Quanta of the film, of what becomes 1 in the picture.
  virtual double quanta_per_unit() const = 0;

  DeviceWorld& world_;

private:
  void run(const compute::Buffer<std::int64_t>& film, const shared::DeviceCamera& camera, std::uint32_t frame, std::uint32_t first,
           std::uint32_t count, double limit)
  {
    run(count, {{"film", film},
                {"energy", world_.energy},
                {"camera", camera},
                {"seed", world_.seed},
                {"frame", frame},
                {"pixels", world_.pixels.on_device},
                {"first", first},
                {"count", count},
                {"film_limit", static_cast<float>(limit)}});
  }

  const char* layer_;
  std::int64_t pixel_samples_;
  compute::Buffer<std::int64_t> film_;
  compute::Buffer<std::int64_t> first_film_; ///< with a pixel for each block of the first picture
  SampledPixels pixels_;
};

} // namespace nephroid::photons
