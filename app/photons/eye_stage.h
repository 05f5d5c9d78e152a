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
        film_(world.zeroed(std::string("film ") + layer, world.film_size())), pixels_(world, settings.pixel_samples)
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

  void state(tracing::State& state) override
  {
    pixels_.state(state);
    state.buffer(film_);
  }

protected:
  /// A step of the kernel, which has `own` arguments beside those of every such kernel. limit: quanta that one contribution may have while
  /// all pixels are sampled; glass, which is sampled as long as the run goes on, may have no more than any number of them can.
  bool sample(std::int64_t pass, compute::Kernel& kernel, double limit, std::initializer_list<compute::Argument> own)
  {
    return pixels_.step(pass, [&](std::uint32_t first, std::uint32_t count) {
      world_.run(kernel, count, 64, own,
                 {{"film", film_},
                  {"energy", world_.energy},
                  {"camera", world_.tables.camera},
                  {"seed", world_.seed},
                  {"frame", static_cast<std::uint32_t>(pass)},
                  {"pixels", world_.pixels.on_device},
                  {"first", first},
                  {"count", count},
                  {"film_limit", static_cast<float>(pass < pixel_samples_ ? limit : std::min(limit, tracing::film_limit))}});
    });
  }

  /// Stage::develop. quanta_per_unit: of the film, of what becomes 1 in the picture.
  void add_to(job::Picture& picture, double quanta_per_unit) const
  {
    tracing::add_layer(layer_, {film_.read(), quanta_per_unit, [&](std::size_t pixel) { return pixels_.samples(pixel); }}, picture);
  }

  DeviceWorld& world_;

private:
  const char* layer_;
  std::int64_t pixel_samples_;
  compute::Buffer<std::int64_t> film_;
  SampledPixels pixels_;
};

} // namespace nephroid::photons
