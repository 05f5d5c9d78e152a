// SPDX-License-Identifier: Apache-2.0
// The direct layer, row by row: kernels/spectral/direct.cl.
#include "spectral/sampled_pixels.h"
#include "spectral/stages.h"
#include "tracing/film.h"

#include <algorithm>

namespace nephroid::spectral {
namespace {

class DirectStage final : public Stage {
public:
  DirectStage(DeviceWorld& world, const Settings& settings)
      : world_(world), pixel_samples_(settings.pixel_samples), film_(world.zeroed("film direct", world.film_size())),
        kernel_(compute::Program(world.context, "spectral/direct.cl", world.defines).kernel("direct")),
        pixels_(world, settings.pixel_samples)
  {
  }

  const char* name() const override { return "direct"; }
  std::int64_t passes() const override { return pixels_.passes(); }
  double part() const override { return pixels_.part(); }
  double glass_work() const override
  {
    return paths_through_glass * work_of_a_path * static_cast<double>(pixels_.glass()) / static_cast<double>(pixels_.every());
  }
  void share_work(double factor) override { pixels_.sample_one_pass_in(static_cast<double>(pixels_.every()) / factor); }

  bool step(std::int64_t pass) override
  {
    return pixels_.step(pass, [&](std::uint32_t first, std::uint32_t count) {
      world_.run(kernel_, count, 64,
                 {{"reflected_xyz_all", world_.buffers.reflected_xyz_all},
                  {"cluster_cdf", world_.buffers.cluster_cdf},
                  {"film", film_},
                  {"energy", world_.energy},
                  {"camera", world_.tables.camera},
                  {"seed", world_.seed},
                  {"frame", static_cast<std::uint32_t>(pass)},
                  {"pixels", world_.pixels.on_device},
                  {"first", first},
                  {"count", count},
                  {"film_scale", world_.on_device(world_.tables.direct_scale)},
                  {"film_limit", static_cast<float>(pass < pixel_samples_ ? world_.tables.direct_limit
                                                                          : std::min(world_.tables.direct_limit, tracing::film_limit))}});
    });
  }

  void develop(std::int64_t, bool, job::Picture& picture) override
  {
    const auto samples = [&](std::size_t pixel) { return pixels_.samples(pixel); };
    const std::vector<std::int64_t> sums = film_.read();
    tracing::add_layer("direct", {sums, world_.tables.direct_scale * world_.white, samples}, picture);
  }

  void save(tracing::StateWriter& to) const override
  {
    pixels_.save(to);
    to.buffer(film_);
  }
  void load(tracing::StateReader& from) override
  {
    pixels_.load(from);
    from.buffer(film_);
  }

private:
  DeviceWorld& world_;
  std::int64_t pixel_samples_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel kernel_;
  SampledPixels pixels_;
};

} // namespace

std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const Settings& settings)
{
  return std::make_unique<DirectStage>(world, settings);
}

} // namespace nephroid::spectral
