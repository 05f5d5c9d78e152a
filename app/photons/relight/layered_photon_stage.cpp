// SPDX-License-Identifier: Apache-2.0
// The caustic layer, kept as layers: kernels/photons/relight_photons.cl. Every photon of a layer counts alike. So
// photons may be allocated anew when the light changes, and earlier photons stay as good as they were.
#include "photons/effort/emitters.h"
#include "photons/relight/layer_film.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <algorithm>

namespace nephroid::photons {
namespace {

class LayeredPhotonStage final : public Stage {
public:
  LayeredPhotonStage(StageContext& world, const scene::Scene& scene, const Settings&)
      : world_(world), relighting_(relighting_of(world, scene)), emitters_(world.tables.emitters),
        sent_(emitters_.size()), film_(world.context, "film caustic", relighting_.unbent,
                                       world.tables.lights.size() * cluster_count(), world.halves, world.defines),
        // A photon with the power of all lights on a surface in the scene's middle has 2^16 quanta.
        scale_(world.tables.caustic_scale / world.tables.photons_per_batch) {
    kernel_ = compute::Program(world.context, "photons/relight_photons.cl", world.photon_defines()).kernel("photons");
  }

  const char* name() const override { return "photons"; }
  double fraction_done() const override { return slices_.fraction_done(); }
  std::uint64_t photons_per_pass() const override { return world_.tables.photons_per_batch; }
  bool counts_energy() const override { return true; }

  bool advance(std::int64_t pass) override {
    take_light(pass);
    at_.half = static_cast<std::size_t>(pass) % world_.halves;
    const std::int64_t batches = slices_.advance(
        world_.context.communicator(), world_.tables.photons_per_batch, [&](const tracing::PhotonSlice& slice) {
          shared::DevicePhotonLaunch launch = world_.photon_launch();
          launch.first_iteration = static_cast<std::uint32_t>(at_.first_iteration);
          launch.film_scale = world_.on_device(scale_);
          launch.energy_scale = static_cast<float>(world_.tables.energy_scale * relighting_.light.strongest());
          world_.send(kernel_, slice, pass, launch,
                      {{"emitters", world_.emitters},
                       {"film_first", film_.first()},
                       {"film_cells", film_.cells()},
                       {"film_sums", film_.sums()},
                       {"film_layer_count", film_.layer_count()},
                       {"mean_reflectance", relighting_.mean_reflectance},
                       {"energy", world_.energy}});
        });
    if (batches > 0)
      for (std::size_t e = 0; e < emitters_.size(); ++e) sent_[e][at_.half] += emitters_[e].photon_count;
    return batches > 0;
  }

  void develop(std::int64_t, bool, job::Picture& picture) override {
    const std::vector<HalfCounts> counts = photons_of_layers();
    for (std::size_t e = 0; e < emitters_.size(); ++e)
      if (const HalfCounts& layer = counts[layer_of_emitter(e)]; layer[0] <= 0 || layer[1] <= 0)
        picture.error_draw.clear();
    if (world_.halves == 1) picture.error_draw.clear();
    const int reflectors = world_.tables.wavelengths.reflector_count;
    const auto [mean, draw] =
        film_.weigh(mean_and_draw(relighting_.weights.clusters, counts, reflectors, world_.halves, scale_));
    std::vector<float>& rgb = tracing::layer_of(picture, "caustic").rgb;
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] += mean[i];
    for (std::size_t i = 0; i < picture.error_draw.size(); ++i) picture.error_draw[i] += draw[i];
  }

  bool add_spectrum(std::int64_t, bool, job::PixelSpectrum& to) override {
    std::vector<double>& radiance =
        to.layers.emplace_back(job::PixelSpectrum::Layer{"caustic", std::vector<double>(optics::wavelength_count)})
            .radiance;
    const std::vector<HalfCounts> counts = photons_of_layers();
    const auto [x, y] = to.pixel;
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(world_.tables.camera.width) +
                       static_cast<std::size_t>(x);
    for (const LayerSums& seen : film_.pixel(pixel))
      for (std::size_t i = 0; i < seen.sums.size(); ++i) {
        const std::size_t layer = i % film_.layers();
        if (const double sent = counts[layer][0] + counts[layer][1]; sent > 0)
          add_radiance(relighting_.light, world_.tables.wavelengths, layer / cluster_count(),
                       static_cast<int>(layer % cluster_count()), seen.reflector, seen.sums[i] / (sent * scale_),
                       radiance);
      }
    return true;
  }

  void serialize(tracing::Archive& archive) override {
    bool allocated = allocated_ == relighting_.changes;
    archive.value(at_);
    archive.value(allocated);
    slices_.serialize(archive);
    archive.items(std::span(sent_));
    archive.items(std::span(emitters_));
    film_.serialize(archive);
    if (!archive.is_read()) return;
    allocated_ = relighting_.changes - (allocated ? 0 : 1);
    world_.emitters.write(emitters_);
  }

private:
  struct Position {
    std::size_t half = 0;             ///< half of the film that the current pass adds to
    std::int64_t first_iteration = 0; ///< first pass with the present allocation of photons
  };

  std::size_t cluster_count() const { return world_.tables.wavelengths.clusters.size(); }
  std::size_t layer_of_emitter(std::size_t emitter) const {
    return static_cast<std::size_t>(emitters_[emitter].light) * cluster_count() +
           static_cast<std::size_t>(emitters_[emitter].cluster);
  }

  /// The number of an emitter's photons that are done in the current pass.
  double sent_in_hand(const shared::DeviceEmitter& emitter) const {
    return slices_.done_of(emitter.first_photon + emitter.photon_count) - slices_.done_of(emitter.first_photon);
  }

  /// Photons of each [layer], with the fraction of the current pass.
  std::vector<HalfCounts> photons_of_layers() const {
    std::vector<HalfCounts> counts(film_.layers(), HalfCounts{0, 0});
    for (std::size_t e = 0; e < emitters_.size(); ++e) {
      HalfCounts& layer = counts[layer_of_emitter(e)];
      layer = {static_cast<double>(sent_[e][0]), static_cast<double>(sent_[e][1])};
      layer[at_.half] += sent_in_hand(emitters_[e]);
    }
    return counts;
  }

  /// Photons of a light for one half of the film, in the complete passes.
  std::uint64_t sent_by(int light, std::size_t half) const {
    std::uint64_t sum = 0;
    for (std::size_t e = 0; e < emitters_.size(); ++e)
      if (emitters_[e].light == light) sum += sent_[e][half];
    return sum;
  }

  /// Takes a new light: its powers count in the energy balance at once; from the next pass on it allocates photons.
  void take_light(std::int64_t pass) {
    const bool reallocates = slices_.at_start() && allocated_ != relighting_.changes;
    if (!reallocates && shared_ == relighting_.changes) return;
    const std::vector<shared::DeviceEmitter> now =
        layer_emitters(relighting_.light, world_.tables, world_.tables.photons_per_batch);
    for (std::size_t e = 0; e < emitters_.size(); ++e) {
      emitters_[e].share = now[e].share;
      if (!reallocates) continue;
      emitters_[e].photon_count = now[e].photon_count;
      emitters_[e].sequence_start = emitters_[e].sequence_start_high = 0;
      advance_sequence(emitters_[e], std::max(sent_by(emitters_[e].light, 0), sent_by(emitters_[e].light, 1)));
    }
    if (reallocates) number_photons(emitters_);
    shared_ = relighting_.changes;
    if (reallocates) {
      allocated_ = relighting_.changes;
      at_.first_iteration = pass;
    }
    world_.emitters.write(emitters_);
  }

  StageContext& world_;
  const Relighting& relighting_;
  std::vector<shared::DeviceEmitter> emitters_;
  std::vector<std::array<std::uint64_t, 2>>
      sent_;                                 ///< [emitter]: photons of the complete passes for each half of the film
  std::uint64_t shared_ = 0, allocated_ = 0; ///< Relighting::changes when shares and counts were last updated
  LayerFilm film_;
  double scale_; ///< quanta per W m^-2 sr^-1, for one photon that has a layer's whole power
  compute::Kernel kernel_;
  Position at_;
  tracing::PhotonSlices slices_;
};

PlanPart plan_layered_photons(const PlanInput& input) {
  PlanPart part = photon_stage.plan(input);
  part.buffers.clear();
  if (input.caustics.runs)
    plan_layer_film("film caustic", input.tables.lights.size() * input.tables.wavelengths.clusters.size(),
                    unbent_cells(input.tables.camera), input, part);
  return part;
}

} // namespace

const RunPart layered_photon_stage{plan_layered_photons, make_stage<LayeredPhotonStage>, "caustic"};

} // namespace nephroid::photons
