// SPDX-License-Identifier: Apache-2.0
#include "measure/report_curves.h"

#include "measure/report_metrics.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace nephroid::measure {
namespace {

/// How many times the floor is an error of which the floor, at a right angle to it, makes up `share`: 1 - sqrt(1 - 1/k^2) = share, where
/// k = 2 gives 13 % and k = 3 gives 6 %. Of mean squares k squared.
double above_floor(const std::string& metric, double floor, double times)
{
  return floor * (metric_text(metric).is_mean_square() ? times * times : times);
}

std::vector<std::string> metric_names_of(std::span<const RunSummary> runs)
{
  std::vector<std::string> all;
  for (const RunSummary& run : runs) {
    if (!run.history) continue;
    for (std::string& metric : metric_names(*run.history))
      if (std::find(all.begin(), all.end(), metric) == all.end()) all.push_back(std::move(metric));
  }
  return all;
}

/// The metric that most runs name as theirs, the first of equals; empty where none does.
std::string main_metric(std::span<const RunSummary> runs)
{
  std::map<std::string, int> votes;
  std::string most;
  for (const RunSummary& run : runs)
    if (!run.error_column.empty()) ++votes[error_column_of(run.error_column).metric];
  for (const RunSummary& run : runs)
    if (const std::string metric = error_column_of(run.error_column).metric; !metric.empty() && votes[metric] > votes[most]) most = metric;
  return most;
}

RunCurves run_curves(const RunSummary& run, const std::string& metric)
{
  RunCurves curves;
  if (!run.history) return curves;
  for (std::size_t i = 0; i < run.history->columns.size(); ++i) {
    const ErrorColumn column = error_column_of(run.history->columns[i]);
    if (column.metric == metric) (column.is_estimate ? curves.estimate : curves.error) = column_curve(*run.history, i);
  }
  if (!run.reference) return curves;
  const auto floor = run.reference->noise_floor.find(metric);
  if (floor != run.reference->noise_floor.end() && can_be_drawn(floor->second)) curves.noise_floor = floor->second;
  return curves;
}

bool is_empty(const RunCurves& curves) { return curves.judged().errors.empty(); }

} // namespace

std::vector<std::string> metric_names(const job::History& history)
{
  std::vector<std::string> metrics;
  for (const std::string& column : history.columns)
    if (std::string metric = error_column_of(column).metric; std::find(metrics.begin(), metrics.end(), metric) == metrics.end())
      metrics.push_back(std::move(metric));
  return metrics;
}

Curve column_curve(const job::History& history, std::size_t column)
{
  std::vector<double> seconds, errors;
  for (const job::HistoryRow& row : history.rows) {
    if (column >= row.errors.size()) continue;
    seconds.push_back(row.seconds);
    errors.push_back(row.errors[column]);
  }
  return curve_of(seconds, errors);
}

double MetricCurves::lowest_meaningful(std::size_t run) const
{
  return runs[run].is_judged_by_estimate() ? 0 : above_floor(metric, runs[run].noise_floor, 2);
}

std::optional<PowerLaw> MetricCurves::slope(std::size_t run) const
{
  const RunCurves& curves = runs[run];
  return fit_power_law(curves.judged(), curves.is_judged_by_estimate() ? 0 : above_floor(metric, curves.noise_floor, 3));
}

std::vector<MetricCurves> curves_of(std::span<const RunSummary> runs)
{
  std::vector<MetricCurves> all;
  for (const std::string& metric : metric_names_of(runs)) {
    MetricCurves curves{metric, {}};
    for (const RunSummary& run : runs) curves.runs.push_back(run_curves(run, metric));
    if (!std::all_of(curves.runs.begin(), curves.runs.end(), is_empty)) all.push_back(std::move(curves));
  }
  const std::string main = main_metric(runs);
  const auto rank = [&](const MetricCurves& curves) { return curves.metric == main ? 0 : metric_text(curves.metric).falls ? 1 : 2; };
  std::stable_sort(all.begin(), all.end(), [&](const MetricCurves& a, const MetricCurves& b) { return rank(a) < rank(b); });
  return all;
}

} // namespace nephroid::measure
