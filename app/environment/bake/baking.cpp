// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/baking.h"

#include "base/error.h"
#include "base/hashed_bytes.h"

#include <utility>

namespace nephroid::environment {

Baking::Baking(std::shared_ptr<const BakeTask> task, std::uint64_t key, std::filesystem::path file, bool reads,
               std::size_t directions, const mpi::RankContext& context)
    : task_(std::move(task)), context_(context),
      file_(std::move(file)), identity_{key, hash_of(compute::kernel_source(context, "environment/bake.cl"))},
      wanted_(directions) {
  if (context.communicator().broadcast(reads)) read();
  if (!bake_) baker_.emplace(*task_, context_, wanted_);
}

void Baking::advance() {
  baker_->advance();
  if (!baker_->finished()) return;
  photons_ = baker_->photons();
  bake_ = baker_->take();
  baker_.reset(); // frees its device memory for others
  keep();
}

void Baking::begin_anew() {
  bake_.reset();
  baker_.emplace(*task_, context_, wanted_);
}

double Baking::fraction_done() const {
  return bake_ ? 1.0
               : (static_cast<double>(directions()) + baker_->fraction_done()) /
                     static_cast<double>(task_->directions.size());
}

/// All ranks get rank 0's bake.
void Baking::read() {
  const Communicator& communicator = context_.communicator();
  try {
    if (communicator.is_root()) bake_ = read_bake(file_, identity_);
  } catch (const Error& error) {
    warnings_.push_back(error.line() + "; it is baked again");
  }
  is_from_file_ = communicator.broadcast(bake_.has_value());
  if (!is_from_file_ || communicator.is_alone()) return;
  if (!bake_) bake_ = task_->empty_bake();
  bake_->baked = communicator.broadcast(std::move(bake_->baked));
  bake_->light = communicator.broadcast(std::move(bake_->light));
  bake_->ways = communicator.broadcast(std::move(bake_->ways));
}

void Baking::keep() {
  if (!context_.communicator().is_root()) return;
  try {
    write_bake(file_, identity_, *bake_);
  } catch (const Error& error) {
    warnings_.push_back(error.line() + "; the bake is not kept, and the next start bakes again");
  }
}

} // namespace nephroid::environment
