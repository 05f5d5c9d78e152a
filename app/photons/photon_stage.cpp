// SPDX-License-Identifier: Apache-2.0
// Photons that are splatted into the pixel that sees them, and leave their light on receivers:
// kernels/photons/photons.cl.
#include "kernels/photons/photon_map_types.h"
#include "photons/effort/emitters.h"
#include "photons/stage.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace nephroid::photons {
namespace {

/// How much allocation by variance has to lower the variance: its photons take that much longer.
constexpr double least_gain = 1.5;

/// The first batch whose photons are allocated by measurements: after half a pass, as fewer photons show too little,
/// and after one batch of each replicate.
std::int64_t first_reallocation(unsigned batches, unsigned replicates) {
  return std::max<std::int64_t>({batches / 2, 2, replicates});
}

class PhotonStage final : public Stage {
public:
  PhotonStage(StageContext& world, const scene::Scene&, const Settings& settings)
      : world_(world), leaves_light_(world.receivers && settings.estimator != Settings::Estimator::splat),
        insists_(settings.effort == Settings::Effort::variance),
        by_variance_(insists_ || settings.effort == Settings::Effort::automatic), allocation_(world.tables.emitters),
        guide_(by_variance_ ? world.tables.lights.size() : 0),
        moments_(world.zeroed("variance of each emitter", by_variance_ ? world.tables.emitters.size() : 0)),
        guide_moments_(world.zeroed("variance of each direction",
                                    by_variance_ ? world.tables.lights.size() * EmissionGuide::cells : 0)),
        guide_table_(world.context, "guide of directions", guide_.table()),
        weights_(world.tables.meter ? world.pixels.count : 0, 1.0f), worth_(world.context, "worth of cells", weights_),
        film_(world.zeroed("film caustic", world.film_size())) {
    make_kernel();
  }

  const char* name() const override { return "photons"; }
  double fraction_done() const override {
    return (static_cast<double>(batch_) + slices_.fraction_done()) / world_.tables.batches;
  }
  std::uint64_t photons_per_pass() const override { return world_.tables.photons_per_pass(); }
  bool counts_energy() const override { return true; }

  bool advance(std::int64_t pass) override {
    advance_to(pass, world_.tables.batches);
    if (batch_ < world_.tables.batches) return false;
    batch_ = 0;
    if (StageContext::is_taken(pass)) take_light((pass + 1) * world_.tables.batches);
    return true;
  }

  bool has_halves(std::int64_t passes, bool done) const override { return batches(passes, done) >= 2; }

  /// What was measured with another worth is forgotten; the present guide stays until there is more.
  void weigh_cells(const std::vector<float>& worth) override {
    weights_ = worth;
    worth_.write(weights_);
    forgets_ = true;
  }

  bool advance_preview() override {
    if (batch_ < world_.preview.batches) advance_to(0, world_.preview.batches);
    if (batch_ < world_.preview.batches) return false;
    take_light(batch_);
    return true;
  }

  void develop(std::int64_t passes, bool done, job::Picture& picture) override {
    const std::array<double, 2> samples = tracing::halves_of(batches(passes, done), slices_.fraction_done());
    tracing::add_layer("caustic",
                       {world_.context.all_reduced_sum(film_), world_.tables.caustic_scale * world_.white,
                        [samples](std::size_t) { return samples; }},
                       picture);
  }

  void serialize(tracing::Archive& archive) override {
    const bool was_by_variance = by_variance_;
    slices_.serialize(archive);
    archive.value(batch_);
    archive.value(by_variance_);
    archive.buffer(film_);
    allocation_.serialize(archive);
    guide_.serialize(archive);
    archive.buffer(moments_);
    archive.buffer(guide_moments_);
    archive.value(forgets_);
    archive.items(weights_);
    if (archive.is_read() && !weights_.empty()) worth_.write(weights_);
    if (archive.is_read()) write_allocation();
    if (by_variance_ != was_by_variance) make_kernel();
  }

private:
  /// The next slice of the pass, which has no photons of its batch `end` or a later one.
  void advance_to(std::int64_t pass, std::int64_t end) {
    const RunTables& t = world_.tables;
    const std::int64_t batch = pass * t.batches + batch_;
    if (by_variance_ && slices_.at_start() && batch >= first_reallocation(t.batches, world_.halves) &&
        allocation_.is_due(batch))
      reallocate(batch);
    if (std::exchange(forgets_, false)) { // not before: the moments are what a guide that is due is made of
      guide_.forget();
      moments_.fill_zero();
      guide_moments_.fill_zero();
    }
    // A batch that may be reallocated, of a number that is a power of 2, begins a slice.
    const std::int64_t reallocated = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(batch) + 1)),
                       most = std::min<std::int64_t>(end - batch_, by_variance_ ? reallocated - batch : t.batches);
    shared::DevicePhotonLaunch launch = world_.photon_launch();
    launch.first_iteration = static_cast<std::uint32_t>(allocation_.first_iteration());
    launch.photons_per_batch = t.photons_per_batch;
    launch.emitter_count = t.scene.emitter_count;
    launch.film_scale = world_.on_device(t.caustic_scale);
    launch.energy_scale = world_.on_device(t.energy_scale);
    launch.unseen_weight = unseen_weight();
    if (leaves_light_) launch.stored_scale = world_.on_device(world_.receivers->quanta_per_watt());
    batch_ += slices_.advance(
        world_.context.communicator(), t.photons_per_batch,
        [&](const tracing::PhotonSlice& slice) {
          world_.send(kernel_, slice, batch, launch,
                      {{"emitters", world_.emitters},
                       {"film", film_},
                       {"energy", world_.energy},
                       {"moments", moments_},
                       {"guide_moments", guide_moments_},
                       {"guide", guide_table_},
                       {"worth", worth_},
                       {"stored", no_photons_},
                       {"receiver_table", leaves_light_ ? world_.receivers->table() : no_table_},
                       {"light", leaves_light_ ? world_.receivers->sums() : no_light_}});
        },
        most);
  }

  /// Shows what so many batches have left on receivers.
  void take_light(std::int64_t batches) {
    if (!leaves_light_) return;
    world_.receivers->take_points(KindOfLight::caustic, world_.of_halves(batches));
  }

  std::int64_t batches(std::int64_t passes, bool done) const {
    return passes * world_.tables.batches + (done ? world_.tables.batches : batch_);
  }

  void make_kernel() {
    compute::Defines defines = world_.photon_defines();
    defines["NEPHROID_MOMENTS"] = std::to_string(int(by_variance_));
    defines["NEPHROID_RECEIVERS"] = std::to_string(int(leaves_light_));
    kernel_ = compute::Program(world_.context, "photons/photons.cl", defines).kernel("photons");
  }

  /// Allocates the photons from this batch on by what the earlier batches have measured.
  void reallocate(std::int64_t batch) {
    std::vector<double> photons(world_.tables.lights.size(), 0); // photons of each light in a pass
    for (const shared::DeviceEmitter& e : allocation_.emitters())
      photons[static_cast<std::size_t>(e.light)] = e.light_photon_count;
    guide_.learn(world_.context.all_reduced_sum(guide_moments_), photons,
                 static_cast<double>(batch - allocation_.first_iteration()));
    allocation_.reallocate(batch, world_.context.all_reduced_sum(moments_), world_.halves);
    if (!insists_ && batch > first_reallocation(world_.tables.batches, world_.halves) &&
        allocation_.gain() < least_gain) {
      by_variance_ = false;
      make_kernel();
      allocation_.restore_initial(batch, world_.halves);
    }
    moments_.fill_zero();
    guide_moments_.fill_zero();
    write_allocation();
  }

  void write_allocation() {
    world_.emitters.write(allocation_.emitters());
    guide_table_.write(guide_.table());
  }

  /// The weight of a photon that only glass or a mirror will show: a quarter of that of a splat on a surface as far
  /// away as the scene's middle, to which RunTables::caustic_scale gives 2^16 quanta.
  float unseen_weight() const {
    const RunTables& t = world_.tables;
    return static_cast<float>(0.25 * std::exp2(16) * t.photons_per_batch * std::numbers::pi /
                              (t.caustic_scale * t.light_towards_targets_w));
  }

  StageContext& world_;
  bool leaves_light_; ///< on receivers
  bool insists_;      ///< whether the preset asks for allocation by variance
  bool by_variance_;  ///< whether photons are measured, and allocated and guided by that
  NeymanAllocation allocation_;
  EmissionGuide guide_;
  compute::Buffer<std::int64_t> moments_;       ///< [emitter], see NeymanAllocation::reallocate
  compute::Buffer<std::int64_t> guide_moments_; ///< [light][GUIDE_CELLS], see EmissionGuide::learn
  compute::Buffer<float> guide_table_;
  std::vector<float> weights_;   ///< what is in worth_
  compute::Buffer<float> worth_; ///< of a meter's cells, see weigh_cells
  bool forgets_ = false;         ///< what was measured until now, when the next batch begins
  compute::Buffer<std::int64_t> film_;
  compute::Buffer<shared::StoredPhoton> no_photons_{world_.context, "no photons", 0};
  compute::Buffer<int> no_table_{world_.context, "no receivers", 0};
  compute::Buffer<std::int64_t> no_light_{world_.context, "no receivers", 0};
  compute::Kernel kernel_;
  tracing::PhotonSlices slices_;
  std::int64_t batch_ = 0; ///< number of the batch in the current pass
};

PlanPart plan_photons(const PlanInput& input) {
  if (!input.caustics.runs) return {.decisions = {input.caustics}};
  if (input.is_sppm()) return {.decisions = {{"photons", false, "spectral.estimator is sppm: nothing is splatted"}}};
  PlanPart part{.decisions = {input.caustics}, .buffers = {{"film caustic", input.film_bytes()}}};
  using Effort = Settings::Effort;
  if (const Effort effort = input.settings.effort; effort == Effort::variance || effort == Effort::automatic)
    part.buffers.push_back({"guide of directions",
                            input.tables.lights.size() *
                                (EmissionGuide::floats * sizeof(float) + EmissionGuide::cells * sizeof(std::int64_t))});
  if (const int wanted = input.settings.photons_per_pass;
      input.tables.photons_per_pass() > static_cast<unsigned>(wanted))
    part.notes.push_back(
        fmt::format("spectral.photons_per_pass: raised from {} to {}, one for each cluster of each light", wanted,
                    input.tables.photons_per_pass()));
  return part;
}

} // namespace

const RunPart photon_stage{plan_photons, make_stage<PhotonStage>, "caustic"};

} // namespace nephroid::photons
