// SPDX-License-Identifier: Apache-2.0
// The layer "background": kernels/spectral/background.cl.
#include "spectral/stages.h"
#include "spectral/tables/background_tables.h"
#include "tracing/film.h"
#include "tracing/pixel_rows.h"

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
        film_(world.zeroed("film background", world.film_size())), rows_(world.tables.camera.height)
  {
    compute::Defines defines = world.defines;
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // every path has a wavelength of its own
    defines.insert_or_assign("NEPHROID_ONE_WAY", std::to_string(goes_one_way(scene) ? 1 : 0));
    kernel_ = compute::Program(world.context, "spectral/background.cl", defines).kernel("background");
  }

  const char* name() const override { return "background"; }
  std::int64_t passes() const override { return pixel_samples_; }
  double part() const override { return rows_.part(); }

  bool step(std::int64_t pass) override
  {
    return rows_.step([&](int first_row, int rows) {
      const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(world_.tables.camera.width);
      world_.run(kernel_, pixels, 64,
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
                  {"first_row", first_row},
                  {"row_count", rows},
                  {"film_scale", static_cast<float>(tables_.film_scale)},
                  {"film_limit", static_cast<float>(tables_.limit)}});
    });
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override
  {
    const auto samples = [&](int row) { return rows_.samples(row, passes, done, pixel_samples_); };
    const std::vector<std::int64_t> sums = film_.read();
    tracing::add_layer("background", {sums, tables_.film_scale * world_.white / radiance_, samples}, picture);
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
  double radiance_; ///< of the texel (1, 1, 1)
  BackgroundTables tables_;
  compute::Buffer<float> texels_;
  compute::Buffer<shared::float4> primary_xyz_;
  compute::Buffer<int> wavelengths_;
  compute::Buffer<float> spectrum_cdf_;
  compute::Buffer<std::int64_t> film_;
  compute::Kernel kernel_;
  tracing::PixelRows rows_;
};

} // namespace

std::unique_ptr<Stage> make_background_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings)
{
  return std::make_unique<BackgroundStage>(world, scene, settings);
}

} // namespace nephroid::spectral
