// SPDX-License-Identifier: Apache-2.0
// The direct layer, kept as layers: kernels/photons/relight_direct.cl.
#include "photons/relight/layer_film.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <cmath>
#include <utility>

namespace nephroid::photons {
namespace {

class LayeredDirectStage final : public Stage {
public:
  LayeredDirectStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : world_(world), relighting_(relighting_of(world, scene)), pixel_samples_(*settings.pixel_samples),
        unbent_(world.context, "film direct", relighting_.unbent, world.tables.lights.size(), world.halves,
                world.defines),
        bent_(world.context, "film direct through glass", relighting_.bent,
              world.tables.lights.size() * world.tables.wavelengths.clusters.size(), world.halves, world.defines),
        cluster_cdf_(world.context, "cluster choice", world.tables.wavelengths.cluster_cdf),
        kernel_(compute::Program(world.context, "photons/relight_direct.cl", world.defines).kernel("direct")),
        rows_(world.tables.camera.height, 16) {}

  const char* name() const override { return "direct"; }
  std::int64_t passes() const override { return pixel_samples_; }
  double fraction_done() const override { return rows_.fraction_done(); }

  bool advance(std::int64_t pass) override {
    if (std::exchange(chosen_for_, relighting_.changes) != relighting_.changes)
      cluster_cdf_.write(layer_cluster_cdf(relighting_.light, world_.tables.wavelengths));
    return rows_.advance(world_.context.communicator(), [&](std::uint32_t first_row, std::uint32_t rows) {
      const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(world_.tables.camera.width);
      // A sample through glass adds to one cell as often as it has paths.
      const auto limit = static_cast<float>(world_.tables.direct_limit / paths_through_glass);
      const shared::DeviceRowLaunch launch{world_.seed,
                                           static_cast<std::uint32_t>(pass),
                                           static_cast<int>(first_row),
                                           static_cast<int>(rows),
                                           world_.on_device(world_.tables.direct_scale),
                                           limit,
                                           0};
      world_.run(kernel_, pixels, 64,
                 {{"cluster_cdf", cluster_cdf_},
                  {"mean_reflectance", relighting_.mean_reflectance},
                  {"luminance_share", relighting_.luminance_share},
                  {"unbent_first", unbent_.first()},
                  {"unbent_cells", unbent_.cells()},
                  {"unbent_sums", unbent_.sums()},
                  {"unbent_layer_count", unbent_.layer_count()},
                  {"bent_first", bent_.first()},
                  {"bent_cells", bent_.cells()},
                  {"bent_sums", bent_.sums()},
                  {"bent_layer_count", bent_.layer_count()},
                  {"energy", world_.energy},
                  {"camera", world_.tables.camera},
                  {"launch", launch}});
    });
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    const int reflectors = world_.tables.wavelengths.reflector_count;
    const double quanta = world_.tables.direct_scale;
    const std::array<std::vector<float>, 2> straight = unbent_.weigh(half_sums(relighting_.weights.whole, reflectors,
                                                                               world_.halves, quanta)),
                                            through = bent_.weigh(half_sums(relighting_.weights.clusters, reflectors,
                                                                            world_.halves, quanta));
    std::vector<float>& rgb = tracing::layer_of(picture, "direct").rgb;
    const std::size_t row_length = 3 * static_cast<std::size_t>(picture.width);
    for (std::size_t row = 0; row < static_cast<std::size_t>(picture.height); ++row) {
      const auto [a, b] = samples_of_row(row, passes, done);
      if (a <= 0 || b <= 0 || world_.halves == 1) picture.error_draw.clear();
      const double mean = a + b > 0 ? 1 / (a + b) : 0, of_a = mean * std::sqrt(b / a), of_b = mean * std::sqrt(a / b);
      for (std::size_t i = row * row_length; i < (row + 1) * row_length; ++i) {
        const double first = straight[0][i] + through[0][i], second = straight[1][i] + through[1][i];
        rgb[i] += static_cast<float>(mean * (first + second));
        if (!picture.error_draw.empty()) picture.error_draw[i] += static_cast<float>(of_a * first - of_b * second);
      }
    }
  }

  bool add_spectrum(std::int64_t passes, bool done, job::PixelSpectrum& to) override {
    std::vector<double>& radiance =
        to.layers.emplace_back(job::PixelSpectrum::Layer{"direct", std::vector<double>(optics::wavelength_count)})
            .radiance;
    const auto [x, y] = to.pixel;
    const auto [a, b] = samples_of_row(static_cast<std::size_t>(y), passes, done);
    const double unit = a + b > 0 ? 1 / ((a + b) * world_.tables.direct_scale) : 0;
    const int clusters = static_cast<int>(world_.tables.wavelengths.clusters.size());
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(world_.tables.camera.width) +
                       static_cast<std::size_t>(x);
    for (const LayerFilm* film : {&unbent_, &bent_})
      for (const LayerSums& seen : film->pixel(pixel))
        for (std::size_t i = 0; i < seen.sums.size(); ++i) {
          const auto layer = static_cast<int>(i % film->layers());
          const int light = film == &bent_ ? layer / clusters : layer, cluster = film == &bent_ ? layer % clusters : -1;
          add_radiance(relighting_.light, world_.tables.wavelengths, static_cast<std::size_t>(light), cluster,
                       seen.reflector, seen.sums[i] * unit, radiance);
        }
    return true;
  }

  void serialize(tracing::Archive& archive) override {
    rows_.serialize(archive);
    unbent_.serialize(archive);
    bent_.serialize(archive);
  }

private:
  /// The samples of a pixel of the row in each half of the film.
  std::array<double, 2> samples_of_row(std::size_t row, std::int64_t passes, bool done) const {
    const bool sampled = done || static_cast<std::int64_t>(row) < rows_.done();
    return passes >= pixel_samples_ ? tracing::halves_of(pixel_samples_, 0)
                                    : tracing::halves_of(passes, sampled ? 1 : 0);
  }

  StageContext& world_;
  const Relighting& relighting_;
  std::int64_t pixel_samples_;
  LayerFilm unbent_, bent_;
  compute::Buffer<float> cluster_cdf_;
  std::uint64_t chosen_for_ = 0; ///< Relighting::changes of the light that cluster_cdf_ was made for
  compute::Kernel kernel_;
  tracing::PixelSlices rows_;
};

PlanPart plan_layered_direct(const PlanInput& input) {
  PlanPart part{.decisions = direct_stage.plan(input).decisions};
  if (!part.decisions[0].runs) return part;
  const RunTables& tables = input.tables;
  const std::size_t lights = tables.lights.size(), clusters = tables.wavelengths.clusters.size();
  plan_layer_film("film direct", lights, unbent_cells(tables.camera), input, part);
  plan_layer_film("film direct through glass", lights * clusters, bent_cells(tables.camera, tables.spheres), input,
                  part);
  return part;
}

} // namespace

const RunPart layered_direct_stage{plan_layered_direct, make_stage<LayeredDirectStage>, "direct"};

} // namespace nephroid::photons
