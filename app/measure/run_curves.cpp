// SPDX-License-Identifier: Apache-2.0
#include "measure/run_curves.h"

#include <algorithm>
#include <cmath>

namespace nephroid::measure {
namespace {

constexpr std::size_t least_points = 4;
constexpr double least_time_ratio = 2;

/// The half distances to the neighbours on the log time axis (the trapezoid rule's weights).
std::vector<double> log_time_weights(const std::vector<double>& x) {
  std::vector<double> weights(x.size());
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double half = (x[i + 1] - x[i]) / 2;
    weights[i] += half;
    weights[i + 1] += half;
  }
  return weights;
}

/// Where the segment between two points has the error, which lies between theirs.
double seconds_on_segment(const Curve& curve, std::size_t end, double error) {
  const double before = std::log(curve.errors[end - 1]), after = std::log(curve.errors[end]);
  const double share = (std::log(error) - before) / (after - before);
  return curve.seconds[end - 1] * std::pow(curve.seconds[end] / curve.seconds[end - 1], share);
}

constexpr std::string_view estimated_prefix = "estimated_", masked = "masked_";

/// k times the floor (mean squares: k^2), where the floor, at a right angle, makes up 1 - sqrt(1 - 1/k^2) of an error.
double above_floor(const RunCurves& curves, double times) {
  if (curves.is_judged_by_estimate()) return 0;
  return curves.noise_floor * (metric_text(curves.metric).is_mean_square() ? times * times : times);
}

Curve column_curve(const job::History& history, std::size_t column, bool falls) {
  Curve curve;
  for (const job::HistoryRow& row : history.rows) {
    if (column >= row.errors.size()) continue;
    const double error = row.errors[column];
    if (!can_be_drawn(row.seconds) || !(falls ? can_be_drawn(error) : std::abs(error) < 1e100)) continue;
    curve.seconds.push_back(row.seconds);
    curve.errors.push_back(error);
  }
  return curve;
}

} // namespace

bool can_be_drawn(double value) { return value > 1e-100 && value < 1e100; }

std::optional<PowerLaw> fit_power_law(const Curve& curve, double lowest_error) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < curve.seconds.size(); ++i) {
    if (curve.errors[i] < lowest_error) continue;
    x.push_back(std::log(curve.seconds[i]));
    y.push_back(std::log(curve.errors[i]));
  }
  if (x.size() < least_points || x.back() - x.front() < std::log(least_time_ratio)) return std::nullopt;
  const std::vector<double> weights = log_time_weights(x);
  double total = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    total += weights[i];
    mean_x += weights[i] * x[i];
    mean_y += weights[i] * y[i];
  }
  mean_x /= total;
  mean_y /= total;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += weights[i] * (x[i] - mean_x) * (x[i] - mean_x);
    xy += weights[i] * (x[i] - mean_x) * (y[i] - mean_y);
  }
  const double exponent = xy / xx;
  return PowerLaw{exponent, std::exp(mean_y - exponent * mean_x), x.size()};
}

std::optional<ErrorRange> errors_reached(const Curve& curve) {
  if (curve.errors.empty()) return std::nullopt;
  return ErrorRange{*std::min_element(curve.errors.begin(), curve.errors.end()), curve.errors.front()};
}

std::optional<ErrorRange> errors_both_reached(const Curve& a, const Curve& b, double lowest_error) {
  const auto of_a = errors_reached(a), of_b = errors_reached(b);
  if (!of_a || !of_b) return std::nullopt;
  const ErrorRange both{std::max({of_a->lowest, of_b->lowest, lowest_error}), std::min(of_a->highest, of_b->highest)};
  if (both.lowest > both.highest) return std::nullopt;
  return both;
}

std::optional<double> seconds_to_reach(const Curve& curve, double error) {
  if (curve.errors.empty() || curve.errors.front() < error) return std::nullopt;
  for (std::size_t i = 0; i < curve.errors.size(); ++i) {
    if (curve.errors[i] > error) continue;
    return i == 0 ? curve.seconds.front() : seconds_on_segment(curve, i, error);
  }
  return std::nullopt;
}

std::optional<EqualError> at_equal_error(const Curve& a, const Curve& b, double error) {
  const auto seconds_a = seconds_to_reach(a, error), seconds_b = seconds_to_reach(b, error);
  if (!seconds_a || !seconds_b) return std::nullopt;
  return EqualError{error, *seconds_a, *seconds_b};
}

std::vector<double> round_levels(double lowest, double highest) {
  std::vector<double> levels;
  if (!(lowest > 0) || !std::isfinite(highest)) return levels;
  constexpr double slack = 1e-9; // 0.2 and 2 * 10^-1 may differ in the last bit
  for (int power = static_cast<int>(std::floor(std::log10(highest))); power >= std::floor(std::log10(lowest)); --power)
    for (const double digit : {5.0, 2.0, 1.0}) {
      // 10^-n as a quotient: exact powers of ten make the nearest double of the decimal number
      const double level = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
      if (level >= lowest * (1 - slack) && level <= highest * (1 + slack)) levels.push_back(level);
    }
  return levels;
}

ErrorColumn error_column_of(std::string_view column) {
  if (column.starts_with(estimated_prefix)) return {std::string(column.substr(estimated_prefix.size())), true};
  return {std::string(column), false};
}

MetricText metric_text(std::string_view metric) {
  if (metric.starts_with(masked)) {
    MetricText text = metric_text(metric.substr(masked.size()));
    text.label += ", inside the mask";
    return text;
  }
  const auto known = std::ranges::find(all_metrics(), metric, &Metric::name);
  return known == all_metrics().end() ? MetricText{std::string(metric), "", std::nullopt, false} : known->text;
}

std::vector<std::string> metric_names(const job::History& history) {
  std::vector<std::string> metrics;
  for (const std::string& column : history.columns)
    if (std::string metric = error_column_of(column).metric;
        std::find(metrics.begin(), metrics.end(), metric) == metrics.end())
      metrics.push_back(std::move(metric));
  return metrics;
}

double RunCurves::lowest_meaningful() const { return above_floor(*this, 2); }

std::optional<PowerLaw> RunCurves::slope() const {
  if (!falls) return std::nullopt;
  return fit_power_law(judged(), above_floor(*this, 3));
}

bool is_error(const job::History& history, const std::string& metric) {
  return metric_text(metric).falls || metric == error_column_of(history.error_column).metric;
}

RunCurves run_curves(const job::History& history, const std::string& metric, bool falls) {
  RunCurves curves;
  curves.metric = metric;
  curves.falls = falls;
  for (std::size_t i = 0; i < history.columns.size(); ++i) {
    const ErrorColumn column = error_column_of(history.columns[i]);
    if (column.metric != metric) continue;
    (column.is_estimate ? curves.estimate : curves.error) = column_curve(history, i, falls);
    if (!column.is_estimate && i < history.noise_floor.size() && can_be_drawn(history.noise_floor[i]))
      curves.noise_floor = history.noise_floor[i];
  }
  return curves;
}

} // namespace nephroid::measure
