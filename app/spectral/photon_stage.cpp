// SPDX-License-Identifier: Apache-2.0
// Photons that are splatted into the pixel that sees them: kernels/photons.cl.
#include "spectral/film.h"
#include "spectral/stages.h"

#include <algorithm>
#include <cmath>

namespace nephroid::spectral {
namespace {

class PhotonStage final : public Stage {
public:
  explicit PhotonStage(DeviceWorld& world)
      : world_(world), film_(world.zeroed("film caustic", world.film_size())),
        photons_per_item_(world.context.device().type == "cpu" ? 16 : 1)
  {
    compute::Defines defines = world.defines;
    defines["NEPHROID_PHOTONS_PER_ITEM"] = std::to_string(photons_per_item_);
    kernel_ = compute::Program(world.context, "photons.cl", defines).kernel("photons");
  }

  const char* name() const override { return "photons"; }
  double part() const override { return static_cast<double>(at_.slice) / at_.slices; }
  std::uint64_t photons_per_pass() const override { return world_.tables.photons_per_pass; }

  bool step(std::int64_t pass) override
  {
    const std::uint32_t all = world_.tables.photons_per_pass;
    if (at_.slice == 0)
      at_.slices = static_cast<std::uint32_t>(std::clamp<std::int64_t>(std::llround(all / photons_a_step_.amount()), 1, all));
    const std::uint32_t count = (all - at_.slice + at_.slices - 1) / at_.slices;
    photons_a_step_.timed(count, [&] {
      world_.run(kernel_, (count + photons_per_item_ - 1) / photons_per_item_, 32, world_.buffers.targets, world_.buffers.emitters, film_,
                 world_.energy, world_.tables.camera, world_.seed, static_cast<std::uint32_t>(pass), at_.slice, at_.slices, count,
                 world_.on_device(world_.tables.caustic_scale), world_.on_device(world_.tables.energy_scale));
    });
    if (++at_.slice < at_.slices) return false;
    at_ = {};
    return true;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override
  {
    const auto samples = [&](int) { return halves_of(passes, done ? 1 : part()); };
    const std::vector<std::int64_t> sums = film_.read();
    const DeviceTables& t = world_.tables;
    add_layer("caustic", {sums, t.camera.width, t.camera.height, t.caustic_scale * world_.white, samples}, picture);
  }

  void save(StateWriter& to) const override
  {
    to.value(at_);
    to.buffer(film_);
  }
  void load(StateReader& from) override
  {
    from.value(at_);
    from.buffer(film_);
  }

private:
  /// Where the pass in hand is: slice s of it has the photons s, s + slices, ...
  struct Position {
    std::uint32_t slice = 0, slices = 1;
  };

  DeviceWorld& world_;
  compute::Buffer<std::int64_t> film_;
  unsigned photons_per_item_;
  compute::Kernel kernel_;
  Position at_;
  StepSize photons_a_step_{8192};
};

} // namespace

std::unique_ptr<Stage> make_photon_stage(DeviceWorld& world) { return std::make_unique<PhotonStage>(world); }

} // namespace nephroid::spectral
