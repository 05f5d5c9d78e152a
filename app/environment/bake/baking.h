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
  /// key: of the bake. directions: how many it will be asked for. reads: the file is there and looks right; where it
  /// turns out wrong, that is a warning. Throws as Baker.
  Baking(std::shared_ptr<const BakeTask> task, std::uint64_t key, std::filesystem::path file, bool reads,
         std::size_t directions, const mpi::RankContext& context);

  const BakeTask& task() const { return *task_; }
  bool is_complete() const { return bake_.has_value(); }
  /// As far as it is. Another object once it is complete; that one stays.
  const Bake& bake() const { return bake_ ? *bake_ : baker_->bake(); }

  /// One slice of about 30 ms, while it is not complete.
  void advance();
  /// Throws a complete bake away: what is baked is a state to be loaded.
  void begin_anew();

  std::int64_t directions() const { return static_cast<std::int64_t>(bake().baked.size()); } ///< complete ones
  double fraction_done() const;                                                              ///< 0..1
  /// That were sent here.
  std::uint64_t photons() const { return bake_ ? photons_ : baker_->photons(); }
  /// Until it is complete; nothing where that is not known.
  std::optional<double> seconds_left() const { return baker_->seconds_left(); }
  bool is_from_file() const { return is_from_file_; }
  /// Of the file, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Of a bake that is not complete.
  void state(tracing::State& state) { baker_->state(state); }

private:
  void read();
  void keep();

  std::shared_ptr<const BakeTask> task_;
  mpi::RankContext context_;
  std::filesystem::path file_;
  BakeIdentity identity_;
  std::size_t wanted_;
  std::optional<Baker> baker_; ///< while it bakes
  std::optional<Bake> bake_;   ///< when that is done
  bool is_from_file_ = false;
  std::uint64_t photons_ = 0; ///< that the finished bake took here
  std::vector<std::string> warnings_;
};

} // namespace nephroid::environment
