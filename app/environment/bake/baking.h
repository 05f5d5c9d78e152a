// SPDX-License-Identifier: Apache-2.0
// The bake of a run: read from its file, or made slice by slice and then kept there.
#pragma once
#include "environment/bake/baker.h"
#include "mpi/rank_context.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::environment {

class Baking {
public:
  /// key: the bake's. directions: how many will be baked. reads: the file is there and looks right; a file that turns
  /// out wrong is a warning. Throws as Baker does.
  Baking(std::shared_ptr<const BakeTask> task, std::uint64_t key, std::filesystem::path file, bool reads,
         std::size_t directions, const mpi::RankContext& context);

  const BakeTask& task() const { return *task_; }
  bool is_complete() const { return bake_.has_value(); }
  /// What is baked so far. It becomes another object when the bake is complete, and stays that one.
  const Bake& bake() const { return bake_ ? *bake_ : baker_->bake(); }

  /// Bakes for one slice of about 30 ms. Only for a bake that is not complete.
  void advance();
  /// Drops a complete bake, because a state is about to be loaded.
  void begin_anew();

  std::int64_t directions() const { return static_cast<std::int64_t>(bake().baked.size()); } ///< complete ones
  double fraction_done() const;                                                              ///< 0..1
  /// The photons that this run has sent.
  std::uint64_t photons() const { return bake_ ? photons_ : baker_->photons(); }
  /// The time until the bake is complete; nothing where that is not known.
  std::optional<double> seconds_left() const { return baker_->seconds_left(); }
  bool is_from_file() const { return is_from_file_; }
  /// What is wrong with the file, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Only for a bake that is not complete.
  void state(tracing::State& state) { baker_->state(state); }

private:
  void read();
  void keep();

  std::shared_ptr<const BakeTask> task_;
  mpi::RankContext context_;
  std::filesystem::path file_;
  BakeIdentity identity_;
  std::size_t wanted_;
  std::optional<Baker> baker_; ///< the bake in work; empty once it is complete
  std::optional<Bake> bake_;   ///< the complete bake
  bool is_from_file_ = false;
  std::uint64_t photons_ = 0; ///< photons that this run sent for the complete bake
  std::vector<std::string> warnings_;
};

} // namespace nephroid::environment
