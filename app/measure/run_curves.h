// SPDX-License-Identifier: Apache-2.0
// The curves of one run, metric by metric, as the window and the report draw and compare them; what the columns of a
// history are called; and what is read off curves of error against time: slopes, the time to an error, speed-ups at
// equal error. Between its points a curve is a straight line on two logarithmic axes, as Monte Carlo's c / sqrt(t) is.
#pragma once
#include "job/history.h"
#include "measure/metrics.h"

namespace nephroid::measure {

/// Whether a value has a place on a logarithmic axis: within 1e-100..1e100, so that its powers are finite as well.
bool can_be_drawn(double value);

/// Errors at times, in the order of time; on logarithmic axes all can be drawn.
struct Curve {
  std::vector<double> seconds, errors;
};

/// error = factor * seconds^exponent.
struct PowerLaw {
  double exponent = 0, factor = 0;
  std::size_t points = 0; ///< that it was fitted to
};

/// Least squares of log error against log seconds over the points with an error of at least lowest_error (0: all).
/// Every point counts as much as the part of the log time axis that it stands for: the error of a running mean times
/// sqrt(t) is a stationary process in log t, so that many rows close together say no more than one. Nothing where fewer
/// than 4 points are left, or the last is not at twice the time of the first.
std::optional<PowerLaw> fit_power_law(const Curve& curve, double lowest_error = 0);

struct ErrorRange {
  double lowest = 0, highest = 0;
};
/// From the error of the first point to the lowest one; nothing of an empty curve.
std::optional<ErrorRange> errors_reached(const Curve& curve);
/// The errors that both curves came down to, not below lowest_error; nothing where there are none.
std::optional<ErrorRange> errors_both_reached(const Curve& a, const Curve& b, double lowest_error = 0);

/// When the curve first falls to the error; nothing where it never does, or begins below it.
std::optional<double> seconds_to_reach(const Curve& curve, double error);

struct EqualError {
  double error = 0;
  double seconds_a = 0, seconds_b = 0;
  double speed_up() const { return seconds_a / seconds_b; } ///< how many times faster b reached it
};
/// Both times to one error; nothing where one of the curves has none.
std::optional<EqualError> at_equal_error(const Curve& a, const Curve& b, double error);

/// 1, 2 and 5 times powers of ten from lowest to highest, both included, the largest first. Both above 0, else none.
std::vector<double> round_levels(double lowest, double highest);

/// A history's column taken apart: "estimated_lab_mean" estimates "lab_mean"; "masked_lab_mean" is a metric by itself.
struct ErrorColumn {
  std::string metric;
  bool is_estimate = false;
};
ErrorColumn error_column_of(std::string_view column);

/// The text of a metric, by its name. A column that an engine adds (cost, temperature) is no error.
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
  /// Errors below it are not compared: twice the floor (four times that of a mean square), where 13 % of the error are
  /// the reference's. 0 for estimates and where no floor is known.
  double lowest_meaningful() const;
  /// The slope of the judged curve down to three times the floor (nine times), where 6 % are the reference's.
  std::optional<PowerLaw> slope() const;
};
/// Whether the metric is an error, or the run itself is judged by it.
bool is_error(const job::History& history, const std::string& metric);
/// What has no place on the axis, which is logarithmic where it falls, is left out.
RunCurves run_curves(const job::History& history, const std::string& metric, bool falls);

} // namespace nephroid::measure
