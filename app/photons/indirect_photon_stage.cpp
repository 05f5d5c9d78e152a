// SPDX-License-Identifier: Apache-2.0
// Photons of the layer "indirect": kernels/photons/indirect_photons.cl. They are splatted, and leave their light on
// receivers for what glass and mirrors show.
#include "base/counted.h"
#include "lights/lights.h"
#include "optics/colour.h"
#include "photons/effort/emitters.h"
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

/// What the film makes of each wavelength of the light at `index` of the tables.
std::vector<double> wavelength_worth(const optics::ColourMatching& eye, const tracing::WavelengthTables& tables,
                                     const scene::Light& light, std::size_t index) {
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

/// tables belong to the same scene. photons is the number wanted in a pass.
IndirectTables make_indirect_tables(const scene::Scene& scene, const RunTables& tables, unsigned photons) {
  IndirectTables result;
  std::vector<PhotonSource> sources;
  for (std::size_t l = 0; l < tables.lights.size(); ++l) {
    const scene::Light& light = scene.lights[static_cast<std::size_t>(tables.lights[l].number)];
    const std::vector<double> weights = wavelength_worth(tracing::response_of(scene), tables.wavelengths, light, l);
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
        energy_(world.zeroed("energy of indirect photons", OUTCOME_COUNT)) {
    compute::Defines defines = world.photon_defines();
    defines.insert_or_assign("NEPHROID_JITTER", std::to_string(1)); // every photon has a wavelength of its own
    defines.insert_or_assign("NEPHROID_DIFFERENTIALS", std::to_string(0));
    defines["NEPHROID_RECEIVERS"] = std::to_string(int(world.keeps_indirect()));
    kernel_ = compute::Program(world.context, "photons/indirect_photons.cl", defines).kernel("indirect_photons");
  }

  const char* name() const override { return "indirect photons"; }
  double fraction_done() const override { return is_sent_ ? 1 : slices_.fraction_done(); }
  std::uint64_t photons_per_pass() const override { return tables_.photons_per_pass; }

  bool advance(std::int64_t pass) override {
    if (!is_sent_ && !send(pass)) return false;
    is_sent_ = false;
    if (world_.keeps_indirect() && StageContext::is_taken(pass))
      world_.receivers->take_points(KindOfLight::indirect, world_.of_halves(pass + 1));
    return true;
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
    if (world_.indirect_seen) world_.add_seen_light(*world_.indirect_seen, "indirect", picture);
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
  }

private:
  bool send(std::int64_t pass) {
    shared::DevicePhotonLaunch launch = world_.photon_launch();
    launch.emitter_count = static_cast<int>(tables_.emitters.size());
    launch.film_scale = world_.on_device(tables_.film_scale);
    launch.energy_scale = world_.on_device(tables_.energy_scale);
    if (world_.receivers) launch.stored_scale = world_.on_device(world_.receivers->quanta_per_watt());
    return slices_.advance(world_.context.communicator(), tables_.photons_per_pass,
                           [&](const tracing::PhotonSlice& slice) {
                             world_.send(kernel_, slice, pass, launch,
                                         {{"emitters", emitters_},
                                          {"spectrum_cdf", spectrum_cdf_},
                                          {"film", film_},
                                          {"energy", energy_},
                                          {"receiver_table", world_.receivers ? world_.receivers->table() : no_table_},
                                          {"light", world_.receivers ? world_.receivers->sums() : no_light_}});
                           }) > 0;
  }

  /// The fraction of the current pass's photons that are sent.
  double sent(bool done) const { return done || is_sent_ ? 1 : slices_.fraction_done(); }

  StageContext& world_;
  IndirectTables tables_;
  compute::Buffer<shared::DeviceEmitter> emitters_;
  compute::Buffer<float> spectrum_cdf_;
  compute::Buffer<std::int64_t> film_, energy_;
  compute::Buffer<int> no_table_{world_.context, "no receivers", 0};
  compute::Buffer<std::int64_t> no_light_{world_.context, "no receivers", 0};
  compute::Kernel kernel_;
  tracing::PhotonSlices slices_;
  bool is_sent_ = false; ///< whether the preview has sent all photons of the first pass
};

PlanPart plan_indirect_photons(const PlanInput& input) {
  if (!indirect_decision(input).runs) return {};
  const bool caustics = input.objects.throw_caustics() && !input.tables.emitters.empty();
  const bool narrow = std::ranges::any_of(input.tables.lights, lights::is_narrow);
  if (!caustics && !narrow) return {};
  plan::Decision decision{
      "indirect photons", true,
      fmt::format("{} for light from walls that {} light",
                  counted(input.settings.indirect_photons_per_pass, "photon a pass", "photons a pass"),
                  caustics && narrow ? "caustics and narrow spots"
                  : caustics         ? "caustics"
                                     : "narrow spots")};
  return part_of(std::move(decision), {{"film indirect photons", input.film_bytes()}});
}

} // namespace

const RunPart indirect_photon_stage{plan_indirect_photons, make_stage<IndirectPhotonStage>, "indirect"};

} // namespace nephroid::photons
