// SPDX-License-Identifier: Apache-2.0
// The curves of one run, metric by metric, as the window and the report draw and compare them; what the columns of a history are called.
#pragma once
#include "job/history.h"
#include "measure/error_curve.h"
#include "measure/metrics.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::measure {

/// A column of a history taken apart: "estimated_lab_mean" is the estimate of "lab_mean"; a mask's metrics ("masked_lab_mean") are
/// metrics of their own.
struct ErrorColumn {
  std::string metric;
  bool is_estimate = false;
};
ErrorColumn error_column_of(std::string_view column);

/// Of a metric by its name. A column that an engine adds (cost, temperature) is called by its name and is no error.
MetricText metric_text(std::string_view metric);

/// Every metric that a history has a column of, in their order, each once.
std::vector<std::string> metric_names(const job::History& history);

/// One run's curves of one metric. Either may be empty.
struct RunCurves {
  std::string metric;
  Curve error;            ///< against the run's reference
  Curve estimate;         ///< the run's own estimate
  double noise_floor = 0; ///< what the reference is off by itself; 0: not known
  bool falls = true;      ///< an error, with slopes and speed-ups

  /// A run is judged by its estimate only where it has nothing better.
  bool is_judged_by_estimate() const { return error.errors.empty(); }
  const Curve& judged() const { return is_judged_by_estimate() ? estimate : error; }
  /// Errors below it are not compared: twice the floor (four times that of a mean square), where 13 % of the error are the reference's.
  /// 0 for estimates and where no floor is known.
  double lowest_meaningful() const;
  /// Of the judged curve down to three times the floor (nine times), where 6 % of the error are the reference's.
  std::optional<PowerLaw> slope() const;
};
/// Whether the metric is an error, or the run itself is judged by it.
bool is_error(const job::History& history, const std::string& metric);
/// What has no place on the axis, which is logarithmic where it falls, is left out.
RunCurves run_curves(const job::History& history, const std::string& metric, bool falls);

} // namespace nephroid::measure
