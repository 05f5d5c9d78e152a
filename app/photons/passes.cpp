// SPDX-License-Identifier: Apache-2.0
#include "photons/passes.h"

#include <algorithm>

namespace nephroid::photons {

void warm_up(StageContext& world, std::span<const TimedStage> stages) {
  const mpi::RankContext& context = world.context;
  if (!context.communicator().broadcast(context.is_cold())) return; // rank 0 may have rendered a reference before
  for (const TimedStage& s : stages) s.stage->warm_up(context.communicator());
  world.energy.fill_zero();
  world.context.finish(); // a run that never starts its work must not end while kernels run
  context.set_warm();
}

void Passes::advance() {
  const std::size_t now = at_.stage;
  bool complete = false;
  work(now, [&] { complete = at_.pass >= stages_[now].stage->passes() || stages_[now].stage->advance(at_.pass); });
  at_.has_begun = !complete;
  if (!complete || ++at_.stage < stages_.size()) return;
  at_.stage = 0;
  ++at_.pass;
}

std::int64_t Passes::most() const {
  std::int64_t most = 0;
  for (const TimedStage& s : stages_) most = std::max(most, s.stage->passes());
  return most;
}

double Passes::fraction_of(std::size_t stage) const {
  return had_turn(stage) ? 1 : stage > at_.stage ? 0 : stages_[stage].stage->fraction_done();
}

double Passes::with_fraction() const {
  double part = 0, count = 0;
  for (std::size_t s = 0; s < stages_.size(); ++s)
    if (at_.pass < stages_[s].stage->passes()) part += fraction_of(s), ++count;
  return static_cast<double>(at_.pass) + (count > 0 ? part / count : 0);
}

std::uint64_t Passes::photons() const {
  std::uint64_t photons = 0;
  for (std::size_t s = 0; s < stages_.size(); ++s)
    photons += static_cast<std::uint64_t>((static_cast<double>(at_.pass) + fraction_of(s)) *
                                          static_cast<double>(stages_[s].stage->photons_per_pass()));
  return photons;
}

double Passes::photon_batches() const {
  for (std::size_t s = 0; s < stages_.size(); ++s)
    if (stages_[s].stage->counts_energy()) return (static_cast<double>(at_.pass) + fraction_of(s)) * batches_;
  return 0;
}

void Passes::state_of_stages(tracing::Archive& archive) {
  for (TimedStage& s : stages_) {
    archive.value(s.seconds);
    s.stage->serialize(archive);
  }
}

void Preview::next(Passes& passes) {
  ++pictures_;
  begin_picture();
  for (std::size_t s = 0; s < passes.stages().size(); ++s)
    passes.work(s, [&] {
      while (!passes.stages()[s].stage->advance_preview()) {
      }
    });
}

void Preview::begin_picture() {
  constexpr unsigned batches_a_picture = 2;
  const Blocks blocks{world_.tables.camera.width, world_.tables.camera.height, edges_[pictures_ - 1]};
  std::vector<bool> may_show_glass(blocks.count());
  for (const std::uint32_t pixel : world_.pixels.glass) may_show_glass[blocks.block_of(pixel)] = true;
  std::vector<std::uint32_t> glass;
  for (std::size_t block = 0; block < may_show_glass.size(); ++block)
    if (may_show_glass[block]) glass.push_back(static_cast<std::uint32_t>(block));
  world_.preview = {blocks, std::min(batches_a_picture * static_cast<unsigned>(pictures_), world_.tables.batches - 1),
                    compute::Buffer(world_.context, "blocks of glass", glass)};
}

} // namespace nephroid::photons
