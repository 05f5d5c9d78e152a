// SPDX-License-Identifier: Apache-2.0
// The layer "background": kernels/spectral/background.cl.
#include "spectral/sampled_pixels.h"
#include "spectral/stages.h"
#include "spectral/tables/background_tables.h"
#include "tracing/film.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace nephroid::spectral {
namespace {

std::vector<int> all_wavelengths()
{
  std::vector<int> all(WAVELENGTH_COUNT);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

class BackgroundStage final : public Stage {
public:
  BackgroundStage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings)
      : world_(world), pixel_samples_(settings.pixel_samples), radiance_(scene.environment->radiance),
        tables_(make_background_tables(*scene.environment, settings.pixel_samples)),
        texels_(tracing::upload_vector(world.context, "environment", scene.environment->rgb)),
        primary_xyz_(tracing::upload_vector(world.context, "colours of the primaries", tables_.primary_xyz)),
        wavelengths_(tracing::upload_vector(world.context, "wavelengths", all_wavelengths())),
        spectrum_cdf_(tracing::upload_vector(world.context, "wavelengths of the environment", tables_.spectrum_cdf)),
        film_(world.zeroed("film background", world.film_size())), pixels_(world, settings.pixel_samples)
  {
    compute::Defines defines = world.defines;
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // every path has a wavelength of its own
    defines.insert_or_assign("NEPHROID_ONE_WAY", std::to_string(goes_one_way(scene) ? 1 : 0));
    kernel_ = compute::Program(world.context, "spectral/background.cl", defines).kernel("background");
  }

  const char* name() const override { return "background"; }
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
      world_.run(
          kernel_, count, 64,
          {{"texels", texels_},
           {"primary_xyz", primary_xyz_},
           {"size", tables_.size},
           {"wavelengths", wavelengths_},
           {"spectrum_cdf", spectrum_cdf_},
           {"film", film_},
           {"energy", world_.energy},
           {"camera", world_.tables.camera},
           {"seed", world_.seed},
           {"frame", static_cast<std::uint32_t>(pass)},
           {"pixels", world_.pixels.on_device},
           {"first", first},
           {"count", count},
           {"film_scale", static_cast<float>(tables_.film_scale)},
           {"film_limit", static_cast<float>(pass < pixel_samples_ ? tables_.limit : std::min(tables_.limit, tracing::film_limit))}});
    });
  }

  void develop(std::int64_t, bool, job::Picture& picture) override
  {
    const auto samples = [&](std::size_t pixel) { return pixels_.samples(pixel); };
    const std::vector<std::int64_t> sums = film_.read();
    tracing::add_layer("background", {sums, tables_.film_scale * world_.white / radiance_, samples}, picture);
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
  double radiance_; ///< of the texel (1, 1, 1)
  BackgroundTables tables_;
  compute::Buffer<float> texels_;
  compute::Buffer<shared::float4> primary_xyz_;
  compute::Buffer<int> wavelengths_;
  compute::Buffer<float> spectrum_cdf_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel kernel_;
  SampledPixels pixels_;
};

} // namespace

std::unique_ptr<Stage> make_background_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings)
{
  return std::make_unique<BackgroundStage>(world, scene, settings);
}

} // namespace nephroid::spectral
