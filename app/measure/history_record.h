// SPDX-License-Identifier: Apache-2.0
// A history in a checkpoint: before the job's own bytes, so that a resumed run goes on with one history.
#pragma once
#include "job/history.h"

#include <cstddef>
#include <span>
#include <vector>

namespace nephroid::measure {

std::vector<std::byte> with_history(std::vector<std::byte> job, const job::History& history, double wall_seconds);

struct SavedHistory {
  job::History history; ///< columns, rows and measuring_seconds only
  double wall_seconds = 0;
  std::span<const std::byte> job; ///< of the checkpoint that was given
};
/// Throws bad_input where the checkpoint is cut or of another version.
SavedHistory split_history(std::span<const std::byte> checkpoint);

/// The rows with other columns: what a row has no value of is NaN. A resumed run may have got a reference that it had not before.
std::vector<job::HistoryRow> rows_in_columns(const job::History& history, const std::vector<std::string>& columns);

} // namespace nephroid::measure
