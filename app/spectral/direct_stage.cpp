// SPDX-License-Identifier: Apache-2.0
// The direct layer, row by row: kernels/spectral/direct.cl.
#include "spectral/stages.h"
#include "tracing/film.h"
#include "tracing/pixel_rows.h"

namespace nephroid::spectral {
namespace {

class DirectStage final : public Stage {
public:
  DirectStage(DeviceWorld& world, const Settings& settings)
      : world_(world), pixel_samples_(settings.pixel_samples), film_(world.zeroed("film direct", world.film_size())),
        kernel_(compute::Program(world.context, "spectral/direct.cl", world.defines).kernel("direct")), rows_(world.tables.camera.height)
  {
  }

  const char* name() const override { return "direct"; }
  std::int64_t passes() const override { return pixel_samples_; }
  double part() const override { return rows_.part(); }

  bool step(std::int64_t pass) override
  {
    return rows_.step([&](int first_row, int rows) {
      const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(world_.tables.camera.width);
      world_.run(kernel_, pixels, 64,
                 {{"reflected_xyz_all", world_.buffers.reflected_xyz_all},
                  {"cluster_cdf", world_.buffers.cluster_cdf},
                  {"film", film_},
                  {"energy", world_.energy},
                  {"camera", world_.tables.camera},
                  {"seed", world_.seed},
                  {"frame", static_cast<std::uint32_t>(pass)},
                  {"first_row", first_row},
                  {"row_count", rows},
                  {"film_scale", world_.on_device(world_.tables.direct_scale)},
                  {"film_limit", static_cast<float>(world_.tables.direct_limit)}});
    });
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override
  {
    const auto samples = [&](int row) { return rows_.samples(row, passes, done, pixel_samples_); };
    const std::vector<std::int64_t> sums = film_.read();
    tracing::add_layer("direct", {sums, world_.tables.direct_scale * world_.white, samples}, picture);
  }

  void save(tracing::StateWriter& to) const override
  {
    rows_.save(to);
    to.buffer(film_);
  }
  void load(tracing::StateReader& from) override
  {
    rows_.load(from);
    from.buffer(film_);
  }

private:
  DeviceWorld& world_;
  std::int64_t pixel_samples_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel kernel_;
  tracing::PixelRows rows_;
};

} // namespace

std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const Settings& settings)
{
  return std::make_unique<DirectStage>(world, settings);
}

} // namespace nephroid::spectral
