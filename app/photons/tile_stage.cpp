// SPDX-License-Identifier: Apache-2.0
// Photons that are splatted as the pieces of their lattices: kernels/photons/tiles.cl.
//
// A lattice's error falls as it grows, and not as lattices are added up. So photons come in rounds, each with as many
// as all before, and the picture is the mean of all complete rounds, in which later ones have larger weights.
#include "kernels/photons/tile_types.h"
#include "photons/stage.h"
#include "photons/tiles/lattices.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace nephroid::photons {
namespace {

/// The part of a pass's photons that tiles have: each takes longer than a point, and the other layers need passes.
constexpr double share = 0.25;

class TileStage final : public Stage {
public:
  TileStage(StageContext& world, const scene::Scene&, const Settings&)
      : world_(world), film_(world.zeroed("film caustic", world.film_size())), sums_(world.film_size(), 0.0),
        bias_(world.film_size() / world.halves, 0.0), energy_(world.zeroed("energy of tiles", OUTCOME_COUNT)),
        kernel_(compute::Program(world.context, "photons/tiles.cl", world.photon_defines()).kernel("tiles")) {
    begin_round();
    see_pixels();
  }

  const char* name() const override { return "photons"; }
  double fraction_done() const override {
    const std::int64_t first = points_of_batches(of_round_), last = points_of_batches(of_round_ + 1);
    const double part = last > first ? double(point_ - first) / double(last - first) : 0;
    return (static_cast<double>(batch_) + part) / world_.tables.batches;
  }
  std::uint64_t photons_per_pass() const override {
    return static_cast<std::uint64_t>(share * static_cast<double>(world_.tables.photons_per_pass()));
  }

  bool advance(std::int64_t) override {
    advance_to(world_.tables.batches);
    if (batch_ < world_.tables.batches) return false;
    batch_ = 0;
    return true;
  }

  bool has_halves(std::int64_t, bool) const override { return batches_ > 0 && world_.halves == 2; }

  bool advance_preview() override {
    if (batch_ < world_.preview.batches) advance_to(world_.preview.batches);
    return batch_ >= world_.preview.batches;
  }

  void develop(std::int64_t, bool, job::Picture& picture) override {
    std::vector<std::int64_t> sums(sums_.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::size_t half = i / bias_.size();
      const double bias = world_.halves == 2 ? bias_[i % bias_.size()] : 0;
      sums[i] = std::llround(sums_[i] + (half == 0 ? bias : -bias));
    }
    const double first = batches_ > 0 ? 1 : 0, second = world_.halves == 2 ? first : 0;
    tracing::add_layer("caustic",
                       {std::move(sums), world_.tables.caustic_scale * 0x1p16 * world_.white,
                        [first, second](std::size_t) {
                          return std::array<double, 2>{first, second};
                        }},
                       picture);
  }

  /// Powers are those of complete rounds: part of a lattice is no fair sample.
  void report(std::int64_t, bool, Energy& energy) override {
    std::vector<std::int64_t> quanta = outcomes_;
    const std::vector<std::int64_t> in_hand = world_.context.all_reduced_sum(energy_);
    for (std::size_t i = 0; i < quanta.size(); ++i)
      if (is_count(i)) quanta[i] += in_hand[i];
    const double batches = static_cast<double>(std::max<std::int64_t>(batches_, 1));
    energy.caustics = balance_of(outcome_watts(quanta, world_.tables.energy_scale, batches));
  }

  void serialize(tracing::Archive& archive) override {
    archive.value(batch_);
    archive.value(batches_);
    archive.value(of_round_);
    archive.value(point_);
    archive.value(weight_);
    archive.items(std::span(sums_));
    archive.items(std::span(bias_));
    archive.items(std::span(outcomes_));
    archive.buffer(energy_);
    archive.buffer(film_);
    if (archive.is_read()) begin_round();
  }

private:
  void see_pixels() {
    const shared::DeviceCamera& camera = world_.tables.camera;
    const auto corner_count = static_cast<std::uint32_t>((camera.width + 1) * (camera.height + 1));
    compute::Buffer<shared::uint2> corners(world_.context, "what pixels' corners show", corner_count);
    const compute::Program program(world_.context, "photons/pixel_views.cl", world_.defines);
    compute::Kernel of_corners = program.kernel("pixel_corners"), of_pixels = program.kernel("pixel_views");
    world_.run(of_corners, corner_count, 64, {{"camera", camera}, {"corners", corners}, {"count", corner_count}});
    const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    views_ = compute::Buffer<shared::PixelView>(world_.context, "what pixels show", pixels);
    of_pixels.run(pixels, 64,
                  {{"corners", corners}, {"width", camera.width}, {"height", camera.height}, {"views", views_}});
  }

  std::int64_t round_batches() const {
    const std::int64_t most = (std::int64_t{1} << 30) / world_.tables.photons_per_batch;
    return std::clamp<std::int64_t>(batches_, world_.halves, std::max<std::int64_t>(most, world_.halves));
  }
  /// Quanta a unit grow with the round, so that a photon always has as many.
  double growth() const { return static_cast<double>(round_batches()) / world_.halves; }

  void begin_round() {
    lattices_ = make_lattices(world_.tables, world_.halves, share * growth(), world_.seed, batches_);
    on_device_ = compute::Buffer<shared::DeviceLattice>(world_.context, "lattices", lattices_.lattices);
  }

  /// Points of the first batches of the round in hand.
  std::int64_t points_of_batches(std::int64_t batches) const { return lattices_.points * batches / round_batches(); }

  /// The next slice of the round and the pass in hand, which has no points of the pass's batch `end` or a later one.
  void advance_to(std::int64_t end) {
    const std::int64_t last = points_of_batches(std::min(of_round_ + end - batch_, round_batches()));
    if (point_ < last)
      point_ += amount_.advance(world_.context.communicator(), lattices_.points, point_, last - point_,
                                [&](std::uint32_t first, std::uint32_t count) { send(first, count); });
    while (batch_ < end && point_ >= points_of_batches(of_round_ + 1)) {
      ++batch_;
      if (++of_round_ < round_batches()) continue;
      end_round();
      break;
    }
  }

  void send(std::uint32_t first, std::uint32_t count) {
    shared::DevicePhotonLaunch launch = world_.photon_launch();
    launch.film_scale = world_.on_device(world_.tables.caustic_scale * growth());
    launch.energy_scale = world_.on_device(world_.tables.energy_scale * growth());
    if (world_.receivers) launch.stored_scale = world_.on_device(world_.receivers->quanta_per_watt() * growth());
    world_.send(kernel_, {first, 1, count}, batches_, launch,
                {{"lattices", on_device_},
                 {"lattice_count", static_cast<int>(lattices_.lattices.size())},
                 {"views", views_},
                 {"film", film_},
                 {"energy", energy_},
                 {"receiver_table", world_.receivers ? world_.receivers->table() : no_table_},
                 {"light", world_.receivers ? world_.receivers->sums() : no_light_}});
  }

  void end_round() {
    const std::vector<std::int64_t> film = world_.context.all_reduced_sum(film_);
    film_.fill_zero();
    // Between N^1.2, for edges of facets, and N^2, for the bias of smooth maps; both hardly lose by what is between.
    const double weight = std::pow(static_cast<double>(round_batches()), 1.5);
    weight_ += weight;
    const double part = weight / weight_, to_sums = 0x1p16 / growth();
    std::vector<double> added(film.size());
    for (std::size_t i = 0; i < film.size(); ++i) {
      added[i] = static_cast<double>(film[i]) * to_sums - sums_[i];
      sums_[i] += part * added[i];
    }
    if (world_.halves == 2 && batches_ > 0) estimate_bias(added);
    if (world_.receivers) world_.receivers->take_tiles(1 / growth(), part);
    const std::vector<std::int64_t> quanta = world_.context.all_reduced_sum(energy_);
    for (std::size_t i = 0; i < quanta.size(); ++i) outcomes_[i] += quanta[i];
    energy_.fill_zero();
    batches_ += round_batches();
    of_round_ = 0;
    point_ = 0;
    begin_round();
  }

  /// added: by how much the last round is brighter than the mean of those before. What both halves have of it is noise
  /// and bias; what one has and the other has not is as much noise. A bias that falls as 1 / N is 0.7 of it. Where it
  /// is mostly noise, 0.5 of it still is needed: both halves err alike at edges and silhouettes.
  void estimate_bias(const std::vector<double>& added) {
    const std::size_t size = bias_.size();
    double alike2 = 0, apart2 = 0;
    for (std::size_t i = 0; i < size; ++i) {
      bias_[i] = (added[i] + added[size + i]) / 2;
      alike2 += bias_[i] * bias_[i];
      apart2 += std::pow((added[i] - added[size + i]) / 2, 2);
    }
    const double part = alike2 > apart2 ? std::max(0.7 * std::sqrt(1 - apart2 / alike2), 0.5) : 0.5;
    for (double& bias : bias_) bias *= part;
  }

  StageContext& world_;
  compute::Buffer<std::int64_t> film_; ///< of the round in hand
  std::vector<double> sums_;           ///< of the rounds before, as Film::sums
  /// An estimate of the error that the halves share. It is added to one and taken from the other, so that the estimated
  /// error has it.
  std::vector<double> bias_;
  std::vector<std::int64_t> outcomes_ = std::vector<std::int64_t>(OUTCOME_COUNT); ///< of all complete rounds
  compute::Buffer<std::int64_t> energy_;                                          ///< of the round in hand
  double weight_ = 0;                                                             ///< sum of the rounds' weights
  compute::Kernel kernel_;
  Lattices lattices_;
  compute::Buffer<shared::DeviceLattice> on_device_{world_.context, "no lattices", 0};
  compute::Buffer<shared::PixelView> views_{world_.context, "no views", 0};
  compute::Buffer<int> no_table_{world_.context, "no receivers", 0};
  compute::Buffer<std::int64_t> no_light_{world_.context, "no receivers", 0};
  tracing::SliceSize amount_{4096, 256}; ///< fewer would not be worth a launch, however slow the device
  std::int64_t batch_ = 0;               ///< number of the batch in the current pass
  std::int64_t batches_ = 0;             ///< batches of all complete rounds
  std::int64_t of_round_ = 0;            ///< complete batches of the round in hand
  std::int64_t point_ = 0;               ///< points of the round in hand that are done
};

PlanPart plan_tiles(const PlanInput& input) {
  if (!input.caustics.runs) return {.decisions = {input.caustics}};
  std::vector<std::string> notes;
  if (const auto passes = input.preset.stop.passes) {
    const auto most = static_cast<std::uint64_t>(*passes), whole = std::bit_floor(most);
    if (whole != most)
      notes.push_back(fmt::format("stop.passes: the picture is of {} of {} passes: a round of tiles has as many as all "
                                  "before it, and the last one is not complete",
                                  whole, most));
  }
  return {.decisions = {input.caustics},
          .buffers = {{"film caustic", input.film_bytes()},
                      {"what pixels show", sizeof(shared::PixelView) * input.pixels()},
                      {"rounds of tiles (host)", 2 * input.film_bytes(), true}},
          .notes = std::move(notes)};
}

} // namespace

const RunPart tile_stage{plan_tiles, make_stage<TileStage>, "caustic"};

} // namespace nephroid::photons
