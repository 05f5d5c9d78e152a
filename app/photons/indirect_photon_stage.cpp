// SPDX-License-Identifier: Apache-2.0
// Photons of the layer "indirect": kernels/photons/indirect_photons.cl. They are splatted, and stored in a map for what
// glass and mirrors show.
#include "base/counted.h"
#include "lights/lights.h"
#include "optics/colour.h"
#include "photons/effort/emitters.h"
#include "photons/maps/map_film.h"
#include "photons/stage.h"
#include "photons/tables/run_tables.h"
#include "tracing/film.h"
#include "tracing/omissions.h"
#include "tracing/scales.h"
#include "tracing/slices.h"
#include "tracing/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

namespace nephroid::photons {
namespace {

/// What the eye makes of each wavelength of the light at `index` of the tables.
std::vector<double> wavelength_worth(const tracing::WavelengthTables& tables, const scene::Light& light,
                                     std::size_t index) {
  const optics::ColourMatching& eye = optics::cie_1931();
  std::vector<double> weights;
  for (const int wavelength : tables.cluster_wavelengths) {
    const auto w = static_cast<std::size_t>(wavelength);
    const shared::float4& xyz = tables.light_xyz[index * WAVELENGTH_COUNT + w];
    if (is_environment(light)) // its rows hold primaries
      weights.push_back(tracing::worth(light.spectrum[w] * (eye.x[w] + eye.y[w] + eye.z[w]) / 3, light.spectrum[w]));
    else
      weights.push_back(tracing::worth((double(xyz.x) + xyz.y + xyz.z) / 3, xyz.w));
  }
  return weights;
}

struct IndirectTables {
  std::vector<shared::DeviceEmitter>
      emitters;                    ///< photons of one pass: an emitter for each light; cluster and share are unused
  double watts = 0;                ///< power that the photons carry
  std::vector<float> spectrum_cdf; ///< [light][member of cluster_wavelengths]: whole numbers of 2^-24, the last 1
  unsigned photons_per_pass = 0;   ///< photons of a pass: at least one for each light
  double film_scale = 1, energy_scale = 1; ///< quanta per unit of XYZ radiance and per watt, powers of two
};

/// Whether glass or mirrors send light to walls, and show walls to the camera.
bool has_map(const scene::Scene& scene, const RunTables& tables) {
  return !tables.emitters.empty() && tracing::may_see_glass_or_mirror(scene);
}

/// The wavelengths of a cluster in a pass, where photons of the map share them with paths from the eye: 32 in all, as
/// in map_stage.cpp, where there are as many.
int shared_bands(const RunTables& tables) {
  const auto clusters = std::max<std::size_t>(tables.wavelengths.clusters.size(), 1),
             wavelengths = std::min<std::size_t>(tables.wavelengths.cluster_wavelengths.size(), 32);
  return static_cast<int>(std::max<std::size_t>(1, wavelengths / clusters));
}

/// tables belong to the same scene. photons is the number wanted in a pass.
IndirectTables make_indirect_tables(const scene::Scene& scene, const RunTables& tables, unsigned photons) {
  IndirectTables result;
  std::vector<PhotonSource> sources;
  for (std::size_t l = 0; l < tables.lights.size(); ++l) {
    const scene::Light& light = scene.lights[static_cast<std::size_t>(tables.lights[l].number)];
    const std::vector<double> weights = wavelength_worth(tables.wavelengths, light, l);
    const double sent = lights::is_narrow(tables.lights[l]) ? light.power_w : tables.towards_targets_w[l];
    sources.push_back({sent * std::accumulate(weights.begin(), weights.end(), 0.0), static_cast<int>(l), 0, 0});
    result.watts += sent;
    const std::vector<float> cdf = exact_cdf(weights);
    result.spectrum_cdf.insert(result.spectrum_cdf.end(), cdf.begin(), cdf.end());
  }
  result.emitters = make_emitters(sources, photons);
  result.photons_per_pass = count_photons(result.emitters);
  result.film_scale = tracing::splat_scale(scene, result.photons_per_pass, result.watts);
  result.energy_scale = tracing::energy_scale(result.watts);
  return result;
}

class IndirectPhotonStage final : public Stage {
public:
  IndirectPhotonStage(StageContext& world, const scene::Scene& scene, const Settings& settings)
      : world_(world),
        tables_(make_indirect_tables(scene, world.tables, static_cast<unsigned>(settings.indirect_photons_per_pass))),
        emitters_(world.context, "emitters of indirect photons", tables_.emitters),
        spectrum_cdf_(world.context, "wavelengths of indirect photons", tables_.spectrum_cdf),
        film_(world.zeroed("film indirect photons", world.film_size())),
        energy_(world.zeroed("energy of indirect photons", OUTCOME_COUNT)), stored_(world.context, "no photons", 0) {
    compute::Defines defines = world.photon_defines();
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // every photon has a wavelength of its own
    defines.insert_or_assign("NEPHROID_DIFFERENTIALS", std::to_string(0));
    if (has_map(scene, world.tables)) {
      const std::string& shared = world.defines.at("NEPHROID_SHARED_BANDS");
      const std::string bands = std::to_string(shared == "1" ? shared_bands(world.tables) : 1);
      map_.emplace(world.context, tables_.photons_per_pass, world.defines);
      stored_ = map_->stored();
      map_film_ =
          std::make_unique<MapFilm>(world, *map_, scene, settings, "film indirect photon maps",
                                    compute::Defines{{"NEPHROID_JITTER", shared}, {"NEPHROID_PASS_BANDS", bands}});
      defines.insert_or_assign("NEPHROID_STORE", std::to_string(1));
      defines.insert_or_assign("NEPHROID_PASS_BANDS", bands);
    }
    kernel_ = compute::Program(world.context, "photons/indirect_photons.cl", defines).kernel("indirect_photons");
  }

  const char* name() const override { return "indirect photons"; }
  double fraction_done() const override {
    const double photons = is_sent_ ? 1 : slices_.fraction_done();
    return map_film_ ? (photons + map_film_->eye().fraction_done()) / 2 : photons;
  }
  std::uint64_t photons_per_pass() const override { return tables_.photons_per_pass; }

  void warm_up(const Communicator& communicator) override {
    Stage::warm_up(communicator);
    if (map_film_) map_film_->warm_up(photons());
  }

  bool advance(std::int64_t pass) override {
    if (!is_sent_) {
      is_sent_ = send(pass);
      return is_sent_ && !map_film_ && end_pass();
    }
    return map_film_->advance(pass, photons()) && end_pass();
  }

  /// Sends as large a part of the first pass as caustics do, where a pass has more than a few slices.
  bool advance_preview() override {
    const double fraction_of_pass = static_cast<double>(world_.preview.batches) / world_.tables.batches;
    if (tables_.photons_per_pass < 1 << 16 || sent(false) >= fraction_of_pass) return true;
    is_sent_ = send(0);
    return false;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    const double scale = tables_.film_scale * world_.white;
    const auto samples = [&](std::size_t) { return tracing::halves_of(passes, sent(done)); };
    tracing::add_layer("indirect", {world_.context.all_reduced_sum(film_), scale, samples}, picture);
    if (map_film_) map_film_->develop(passes, done, "indirect", scale, picture);
  }

  void report(std::int64_t passes, bool done, Energy& energy) override {
    const double passes_done = static_cast<double>(passes) + sent(done);
    energy.indirect =
        balance_of(outcome_watts(world_.context.all_reduced_sum(energy_), tables_.energy_scale, passes_done));
    energy.caustics.refused_contributions += energy.indirect->refused_contributions;
  }

  void serialize(tracing::Archive& archive) override {
    slices_.serialize(archive);
    archive.value(is_sent_);
    archive.buffer(film_);
    archive.buffer(energy_);
    if (map_film_) map_film_->serialize(archive);
  }

private:
  bool send(std::int64_t pass) {
    if (slices_.at_start()) stored_.fill_zero(); // each photon is stored by one rank
    shared::DevicePhotonLaunch launch = world_.photon_launch();
    launch.emitter_count = static_cast<int>(tables_.emitters.size());
    launch.film_scale = world_.on_device(tables_.film_scale);
    launch.energy_scale = world_.on_device(tables_.energy_scale);
    launch.stored_scale = world_.on_device(photons().per_watt);
    return slices_.advance(world_.context.communicator(), tables_.photons_per_pass,
                           [&](const tracing::PhotonSlice& slice) {
                             world_.send(kernel_, slice, pass, launch,
                                         {{"emitters", emitters_},
                                          {"spectrum_cdf", spectrum_cdf_},
                                          {"film", film_},
                                          {"energy", energy_},
                                          {"stored", stored_}});
                           }) > 0;
  }

  bool end_pass() {
    is_sent_ = false;
    return true;
  }
  /// The fraction of the current pass's photons that are sent.
  double sent(bool done) const { return done || is_sent_ ? 1 : slices_.fraction_done(); }
  MapFilm::Photons photons() const {
    return {tables_.photons_per_pass, 1, tables_.film_scale, photon_scale(tables_.photons_per_pass, tables_.watts)};
  }

  StageContext& world_;
  IndirectTables tables_;
  compute::Buffer<shared::DeviceEmitter> emitters_;
  compute::Buffer<float> spectrum_cdf_;
  compute::Buffer<std::int64_t> film_, energy_;
  std::optional<PhotonMap> map_;
  compute::Buffer<shared::StoredPhoton> stored_; ///< the map's, where there is one
  std::unique_ptr<MapFilm> map_film_;            ///< set with map_
  compute::Kernel kernel_;
  tracing::PhotonSlices slices_;
  bool is_sent_ = false; ///< whether all photons of the current pass are, and are gathered now
};

PlanPart plan_indirect_photons(const PlanInput& input) {
  if (!indirect_decision(input).runs) return {};
  const bool caustics = input.objects.throw_caustics() && !input.tables.emitters.empty();
  const bool narrow = std::ranges::any_of(input.tables.lights, lights::is_narrow);
  if (!caustics && !narrow) return {};
  plan::Decision decision{
      "indirect photons", true,
      fmt::format("{} for light from walls that {} light{}",
                  counted(input.settings.indirect_photons_per_pass, "photon a pass", "photons a pass"),
                  caustics && narrow ? "caustics and narrow spots"
                  : caustics         ? "caustics"
                                     : "narrow spots",
                  has_map(input.scene, input.tables) ? "; what glass and mirrors show of that of caustics is gathered"
                                                     : "")};
  const plan::PlannedBuffer film{"film indirect photons", input.film_bytes()};
  if (!has_map(input.scene, input.tables)) return part_of(std::move(decision), {film});
  PlanPart part =
      plan_gathering(input, std::move(decision), static_cast<std::uint32_t>(input.settings.indirect_photons_per_pass));
  if (map_decision(input).runs || input.is_sppm()) part.notes.clear(); // they are there
  part.buffers.push_back(film);
  part.buffers.push_back({"film indirect photon maps", input.film_bytes()});
  const bool shares = jitter_decision(input).runs || input.tables.wavelengths.takes_light;
  part.defines = {{"NEPHROID_SHARED_BANDS", std::to_string(int(shares))}};
  return part;
}

} // namespace

const RunPart indirect_photon_stage{plan_indirect_photons, make_stage<IndirectPhotonStage>, "indirect"};

} // namespace nephroid::photons
