// SPDX-License-Identifier: Apache-2.0
// A history in a checkpoint, before the job's own bytes, so that a resumed run goes on with one history.
#pragma once
#include "base/bytes.h"
#include "job/history.h"

#include <string>
#include <vector>

namespace nephroid::measure {

struct SavedHistory {
  job::History history; ///< columns, rows and measuring_seconds only
  double wall_seconds = 0;
};

void save_history(const job::History& history, double wall_seconds, ByteSink& to);
/// Throws bad_input where the checkpoint is cut or of another version.
SavedHistory load_history(ByteSource& from);

/// The rows with other columns: what a row has no value of is NaN. A resumed run may have got a reference that it had not before.
std::vector<job::HistoryRow> rows_in_columns(const job::History& history, const std::vector<std::string>& columns);

} // namespace nephroid::measure
