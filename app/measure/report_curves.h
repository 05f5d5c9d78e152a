// SPDX-License-Identifier: Apache-2.0
// The error curves of several runs, metric by metric: what charts and tables of a report are made from.
#pragma once
#include "measure/report_analysis.h"
#include "measure/run_summary.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::measure {

/// Every metric that a history has a column of, in their order, each once.
std::vector<std::string> metric_names(const job::History& history);
/// One column. Rows that have no such cell are left out.
Curve column_curve(const job::History& history, std::size_t column);

/// One run's curves of one metric. Either may be empty.
struct RunCurves {
  Curve error;            ///< against the run's reference
  Curve estimate;         ///< the run's own estimate
  double noise_floor = 0; ///< what the reference is off by itself; 0: not known

  /// A run is judged by its estimate only where it has nothing better.
  bool is_judged_by_estimate() const { return error.errors.empty(); }
  const Curve& judged() const { return is_judged_by_estimate() ? estimate : error; }
};

struct MetricCurves {
  std::string metric;          ///< as report_metrics.h names it
  std::vector<RunCurves> runs; ///< one a run, in their order

  /// Errors below it are not compared: twice the floor (four times that of a mean square), where 13 % of the error are the reference's.
  /// 0 for estimates and where no floor is known.
  double lowest_meaningful(std::size_t run) const;
  /// Of the judged curve down to three times the floor (nine times), where 6 % of the error are the reference's.
  std::optional<PowerLaw> slope(std::size_t run) const;
};

/// Every metric that a run has a value of. First the one that most runs are judged by, then those that fall, in the order of the
/// files, then the others.
std::vector<MetricCurves> curves_of(std::span<const RunSummary> runs);

} // namespace nephroid::measure
