// SPDX-License-Identifier: Apache-2.0
// The ranks of an MPI job as a communicator. MPI itself is in a module (module/module.cpp), loaded under mpirun.
#pragma once
#include "base/communicator.h"
#include "base/error.h"

#include <functional>
#include <optional>
#include <string>

namespace nephroid::mpi {

/// What a command needs of its ranks beside their communicator.
class Ranks : public Communicator::Transport {
public:
  /// "rank 3 on node7"
  virtual std::string name() const = 0;
  /// How many ranks with lower numbers are on the same machine.
  virtual int number_on_host() const = 0;
  /// Returns once rank 0 has called this, too.
  void wait_for_root() {
    std::byte nothing{};
    broadcast({&nothing, 1});
  }
  /// Calls work(0), ..., work(count - 1), each on one rank: whoever is free takes the next. Returns on rank 0 once all
  /// are done, on others once there is nothing to begin. Interrupted, it throws seconds later.
  virtual void distribute(std::int64_t count, const std::function<void(std::int64_t)>& work) = 0;
  /// Ends all ranks at once, with this exit code.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// The module's only function.
inline constexpr const char* module_name = "libnephroid_mpi.so";
inline constexpr const char* open_symbol = "nephroid_open_ranks";
/// Joins the other ranks. Throws failed where MPI does not let threads take turns.
using OpenRanks = Ranks* (*)();

/// The ranks that this process was started with; null where it is alone. Throws failed where MPI cannot be loaded.
std::shared_ptr<Ranks> open_ranks();

/// Throws this rank's error. Where others have one, waits for the end that they bring.
void require_all(Ranks& ranks, const std::optional<Error>& error);

/// Throws bad_input on each rank whose `mine` is not that of rank 0; then no rank goes on. what: "version".
void require_same(Ranks& ranks, const std::string& what, const std::string& mine);

} // namespace nephroid::mpi
