// SPDX-License-Identifier: Apache-2.0
// Photons that are splatted as the pieces of their lattices: kernels/photons/tiles.cl.
//
// A lattice's error falls as it grows, and not as lattices are added up. So photons come in rounds, each with as many as
// all before, and a round counts by the square of its photons.
#include "photons/stage.h"
#include "photons/tiles/lattices.h"
#include "tracing/film.h"
#include "tracing/slices.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::photons {
namespace {

class TileStage final : public Stage {
public:
  TileStage(StageContext& world, const scene::Scene&, const Settings&)
      : world_(world), film_(world.zeroed("film caustic", world.film_size())), sums_(world.film_size(), 0.0),
        kernel_(compute::Program(world.context, "photons/tiles.cl", defines()).kernel("tiles")) {
    begin_round();
    see_corners();
  }

  const char* name() const override { return "photons"; }
  double fraction_done() const override {
    const auto [first, last] = points_of_batch();
    const double part = last > first ? double(point_ - first) / double(last - first) : 0;
    return (static_cast<double>(batch_) + part) / world_.tables.batches;
  }
  std::uint64_t photons_per_pass() const override { return world_.tables.photons_per_pass(); }
  bool counts_energy() const override { return true; }

  bool advance(std::int64_t) override {
    const auto [first, last] = points_of_batch();
    const auto count = std::clamp<std::int64_t>(std::llround(amount_.amount(world_.context.communicator())), 1,
                                                std::max<std::int64_t>(last - point_, 1));
    amount_.timed(static_cast<double>(count), [&] { send(std::min(count, last - point_)); });
    point_ = std::min(point_ + count, last);
    if (point_ < last) return false;
    ++batch_;
    if (++of_round_ == round_batches()) end_round();
    if (batch_ < world_.tables.batches) return false;
    batch_ = 0;
    return true;
  }

  bool has_halves(std::int64_t, bool) const override { return batches_ > 0 && world_.halves == 2; }

  bool advance_preview() override {
    if (batch_ < world_.preview.batches) advance(0);
    return batch_ >= world_.preview.batches;
  }

  void develop(std::int64_t, bool, job::Picture& picture) override {
    std::vector<std::int64_t> sums(sums_.size());
    std::ranges::transform(sums_, sums.begin(), [](double sum) { return std::llround(sum); });
    const double count = batches_ > 0 ? 1 : 0;
    tracing::add_layer("caustic",
                       {std::move(sums), world_.tables.caustic_scale * 0x1p16 * world_.white,
                        [count](std::size_t) { return std::array<double, 2>{count, count}; }},
                       picture);
  }

  void serialize(tracing::Archive& archive) override {
    archive.value(batch_);
    archive.value(batches_);
    archive.value(of_round_);
    archive.value(point_);
    archive.value(weight_);
    archive.items(std::span(sums_));
    archive.buffer(film_);
    if (archive.is_read()) begin_round();
  }

private:
  compute::Defines defines() const {
    compute::Defines defines = world_.photon_defines();
    return defines;
  }

  void see_corners() {
    const shared::DeviceCamera& camera = world_.tables.camera;
    const auto count = static_cast<std::uint32_t>((camera.width + 1) * (camera.height + 1));
    corners_ = compute::Buffer<shared::uint2>(world_.context, "what pixels' corners see", count);
    auto kernel = compute::Program(world_.context, "photons/pixel_corners.cl", world_.defines).kernel("pixel_corners");
    world_.run(kernel, count, 64, {{"camera", camera}, {"corners", corners_}, {"count", count}});
  }

  std::int64_t round_batches() const { return std::max<std::int64_t>(batches_, world_.halves); }
  /// Film quanta a unit grow with the round, so that a photon always has as many.
  double scale() const { return world_.tables.caustic_scale * static_cast<double>(round_batches()) / world_.halves; }

  void begin_round() {
    lattices_ = make_lattices(world_.tables, world_.halves, round_batches() / world_.halves, world_.seed, batches_);
    on_device_ = compute::Buffer<shared::DeviceLattice>(world_.context, "lattices", lattices_.lattices);
  }

  std::array<std::int64_t, 2> points_of_batch() const {
    const std::int64_t points = lattices_.points, batches = round_batches();
    return {points * of_round_ / batches, points * (of_round_ + 1) / batches};
  }

  void send(std::int64_t count) {
    if (count <= 0) return;
    Partition(world_.context.communicator(), lattices_.points).for_own(point_, count, [&](std::int64_t first, std::int64_t own) {
      world_.run_photons(kernel_, static_cast<std::uint32_t>(own),
                         {{"targets", world_.buffers.targets},
                          {"lattices", on_device_},
                          {"corners", corners_},
                          {"film", film_},
                          {"energy", world_.energy},
                          {"lattice_count", static_cast<int>(lattices_.lattices.size())},
                          {"camera", world_.tables.camera},
                          {"seed", world_.seed},
                          {"iteration", static_cast<std::uint32_t>(batches_)},
                          {"first", static_cast<std::uint32_t>(first)},
                          {"count", static_cast<std::uint32_t>(own)},
                          {"film_scale", world_.on_device(scale())},
                          {"energy_scale", world_.on_device(world_.tables.energy_scale * static_cast<double>(round_batches()) / world_.halves)}});
    });
  }

  void end_round() {
    const std::vector<std::int64_t> film = world_.context.all_reduced_sum(film_);
    film_.fill_zero();
    const double batches = static_cast<double>(round_batches()), own = batches * batches;
    weight_ += own;
    const double part = own / weight_, to_sums = world_.tables.caustic_scale * 0x1p16 / scale();
    for (std::size_t i = 0; i < film.size(); ++i)
      sums_[i] += part * (static_cast<double>(film[i]) * to_sums - sums_[i]);
    batches_ += round_batches();
    of_round_ = 0;
    point_ = 0;
    begin_round();
  }

  StageContext& world_;
  compute::Buffer<std::int64_t> film_; ///< of the round in hand
  std::vector<double> sums_;           ///< of the rounds before, as Film::sums
  double weight_ = 0;                  ///< sum of the rounds' weights
  compute::Kernel kernel_;
  Lattices lattices_;
  compute::Buffer<shared::DeviceLattice> on_device_{world_.context, "no lattices", 0};
  compute::Buffer<shared::uint2> corners_{world_.context, "no corners", 0};
  tracing::SliceSize amount_{4096};
  std::int64_t batch_ = 0;    ///< number of the batch in the current pass
  std::int64_t batches_ = 0;  ///< batches of all complete rounds
  std::int64_t of_round_ = 0; ///< complete batches of the round in hand
  std::int64_t point_ = 0;    ///< points of the round in hand that are done
};

PlanPart plan_tiles(const PlanInput& input) {
  if (!input.caustics.runs) return {.decisions = {input.caustics}};
  return {.decisions = {input.caustics}, .buffers = {{"film caustic", 3 * input.film_bytes()}}};
}

} // namespace

const RunPart tile_stage{plan_tiles, make_stage<TileStage>, "caustic"};

} // namespace nephroid::photons
