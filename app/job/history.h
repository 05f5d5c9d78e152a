// SPDX-License-Identifier: Apache-2.0
// Error against run time: what a job noted about its own error while it worked, a row for each measurement. This is the
// data only: measure/measured_job.h measures, measure/run_files.h reads and writes the file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::job {

struct HistoryRow {
  double seconds = 0;         ///< the work's, without start-up and measuring
  double wall_seconds = 0;    ///< since the run began, everything included, also before it was resumed
  std::int64_t step = 0;      ///< steps of job::Progress completed: passes
  std::uint64_t work = 0;     ///< done, in the engine's unit: photons sent
  std::vector<double> errors; ///< one a column; NaN where it is undefined, as psnr_db of identical pictures is
  bool operator==(const HistoryRow&) const = default;
};

/// Columns are metrics of measure/metrics.h: against the reference ("lab_mean"), the same in the mask
/// ("masked_lab_mean"), and the run's own estimate, which needs no reference ("estimated_lab_mean").
struct History {
  std::vector<std::string> columns;
  std::vector<HistoryRow> rows;    ///< seconds never fall
  std::vector<double> noise_floor; ///< [column]: what the reference is off by; NaN: not known. Empty: none is
  std::string error_column;        ///< where a run can stop, first in panels; empty where nothing is measured
  std::optional<double> target;    ///< stop.error, for error_column
  double measuring_seconds = 0;    ///< spent on measuring so far, which `seconds` does not contain
};

/// A row's error in a column by its name; NaN where the history has no such column.
inline double error_in(const History& history, const HistoryRow& row, std::string_view column) {
  for (std::size_t i = 0; i < history.columns.size(); ++i)
    if (history.columns[i] == column) return row.errors.at(i);
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace nephroid::job
