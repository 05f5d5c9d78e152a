// SPDX-License-Identifier: Apache-2.0
#include "measure/run_curves.h"

#include <algorithm>
#include <cmath>

namespace nephroid::measure {
namespace {

constexpr std::string_view estimated_prefix = "estimated_", masked = "masked_";

/// How many times the floor is an error of which the floor, at a right angle to it, makes up `share`: 1 - sqrt(1 - 1/k^2) = share, where
/// k = 2 gives 13 % and k = 3 gives 6 %. Of mean squares k squared.
double above_floor(const RunCurves& curves, double times)
{
  if (curves.is_judged_by_estimate()) return 0;
  return curves.noise_floor * (metric_text(curves.metric).is_mean_square() ? times * times : times);
}

Curve column_curve(const job::History& history, std::size_t column, bool falls)
{
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

ErrorColumn error_column_of(std::string_view column)
{
  if (column.starts_with(estimated_prefix)) return {std::string(column.substr(estimated_prefix.size())), true};
  return {std::string(column), false};
}

MetricText metric_text(std::string_view metric)
{
  if (metric.starts_with(masked)) {
    MetricText text = metric_text(metric.substr(masked.size()));
    text.label += ", inside the mask";
    return text;
  }
  const auto known = std::ranges::find(all_metrics(), metric, &Metric::name);
  return known == all_metrics().end() ? MetricText{std::string(metric), "", std::nullopt, false} : known->text;
}

std::vector<std::string> metric_names(const job::History& history)
{
  std::vector<std::string> metrics;
  for (const std::string& column : history.columns)
    if (std::string metric = error_column_of(column).metric; std::find(metrics.begin(), metrics.end(), metric) == metrics.end())
      metrics.push_back(std::move(metric));
  return metrics;
}

double RunCurves::lowest_meaningful() const { return above_floor(*this, 2); }

std::optional<PowerLaw> RunCurves::slope() const
{
  if (!falls) return std::nullopt;
  return fit_power_law(judged(), above_floor(*this, 3));
}

bool is_error(const job::History& history, const std::string& metric)
{
  return metric_text(metric).falls || metric == error_column_of(history.error_column).metric;
}

RunCurves run_curves(const job::History& history, const std::string& metric, bool falls)
{
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
