// SPDX-License-Identifier: Apache-2.0
// Where the photons' power went, as the mean of the passes, and how a snapshot holds it.
#pragma once
#include "job/job.h"
#include "kernels/tracing/shared_types.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace nephroid::photons {

/// emitted = deposited + missed + absorbed + escaped + lost but for rounding; OUTCOME_* explain each.
struct EnergyBalance {
  double emitted_w = 0, deposited_w = 0, missed_w = 0, absorbed_w = 0, escaped_w = 0, lost_w = 0;
  std::uint64_t refused_contributions = 0; ///< film contributions too large for its fixed point: 0 in a sound run
  std::uint64_t segments = 0;              ///< rays that the paths of all photons are made of
};

struct Energy {
  EnergyBalance caustics;
  /// The balance of the photons of the layer "indirect", where there is one: emitted = absorbed (by any surface, or
  /// inside glass) + escaped + lost + missed (what met neither glass nor a mirror); nothing is deposited.
  std::optional<EnergyBalance> indirect;
};

/// Whether an outcome is a number of all passes, not a power.
constexpr bool is_count(std::size_t outcome) { return outcome == OUTCOME_REFUSED || outcome == OUTCOME_SEGMENTS; }

/// [OUTCOME_*]: W, as the mean of `passes` passes; counts as they are.
using OutcomeWatts = std::array<double, OUTCOME_COUNT>;
OutcomeWatts outcome_watts(std::span<const std::int64_t> quanta, double quanta_per_watt, double passes);
EnergyBalance balance_of(const OutcomeWatts& watts);

/// Adds the scalars of the groups "energy", "indirect_energy" and "paths", and warnings where contributions were
/// refused, or much light was lost. photons: the number sent.
void add_energy(const Energy& energy, std::uint64_t photons, job::Snapshot& snapshot);
/// Reads back what add_energy added to a snapshot. "indirect_energy" is NaN where there is no such layer.
EnergyBalance energy_of(const job::Snapshot& snapshot, const char* group = "energy");

} // namespace nephroid::photons
