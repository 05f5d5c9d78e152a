// SPDX-License-Identifier: Apache-2.0
// The direct layer, row by row: kernels/direct.cl.
#include "spectral/film.h"
#include "spectral/stages.h"

#include <algorithm>
#include <cmath>

namespace nephroid::spectral {
namespace {

class DirectStage final : public Stage {
public:
  DirectStage(DeviceWorld& world, const preset::Spectral& settings)
      : world_(world), pixel_samples_(settings.pixel_samples), film_(world.zeroed("film direct", world.film_size())),
        kernel_(compute::Program(world.context, "direct.cl", world.defines).kernel("direct"))
  {
  }

  const char* name() const override { return "direct"; }
  std::int64_t passes() const override { return pixel_samples_; }
  double part() const override { return static_cast<double>(row_) / height(); }

  bool step(std::int64_t pass) override
  {
    const auto rows = std::clamp<std::int64_t>(std::llround(rows_a_step_.amount()), 1, height() - row_);
    rows_a_step_.timed(static_cast<double>(rows), [&] {
      world_.run(kernel_, static_cast<std::size_t>(rows) * static_cast<std::size_t>(world_.tables.camera.width), 64,
                 world_.buffers.reflected_xyz_all, world_.buffers.cluster_cdf, film_, world_.energy, world_.tables.camera, world_.seed,
                 static_cast<std::uint32_t>(pass), static_cast<int>(row_), static_cast<int>(rows),
                 world_.on_device(world_.tables.direct_scale), static_cast<float>(world_.tables.direct_limit));
    });
    row_ += rows;
    if (row_ < height()) return false;
    row_ = 0;
    return true;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override
  {
    const auto samples = [&](int row) {
      if (passes >= pixel_samples_) return halves_of(pixel_samples_, 0);
      return halves_of(passes, done || row < row_ ? 1 : 0);
    };
    const std::vector<std::int64_t> sums = film_.read();
    const DeviceTables& t = world_.tables;
    add_layer("direct", {sums, t.camera.width, t.camera.height, t.direct_scale * world_.white, samples}, picture);
  }

  void save(StateWriter& to) const override
  {
    to.value(row_);
    to.buffer(film_);
  }
  void load(StateReader& from) override
  {
    from.value(row_);
    from.buffer(film_);
  }

private:
  std::int64_t height() const { return world_.tables.camera.height; }

  DeviceWorld& world_;
  std::int64_t pixel_samples_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel kernel_;
  std::int64_t row_ = 0; ///< rows of the pass in hand that are done
  StepSize rows_a_step_{16};
};

} // namespace

std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const preset::Spectral& settings)
{
  return std::make_unique<DirectStage>(world, settings);
}

} // namespace nephroid::spectral
