// SPDX-License-Identifier: Apache-2.0
#include "ui/error_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

namespace nephroid::ui {
namespace {

constexpr std::string_view estimated = "estimated_";
/// Below this many noise floors nothing is fitted or compared: the floor adds to the error there and bends the line.
constexpr double floors_above = 3;

std::optional<std::size_t> column_of(const job::History& history, const std::string& name)
{
  const auto found = std::find(history.columns.begin(), history.columns.end(), name);
  if (found == history.columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - history.columns.begin());
}

/// At most four points in each of 500 parts of the log time axis: the first, the lowest, the highest, the last. A plot is about
/// as many pixels wide.
measure::Curve thinned(const measure::Curve& curve)
{
  constexpr double parts = 500;
  const std::size_t count = curve.seconds.size();
  if (count < 4 * static_cast<std::size_t>(parts)) return curve;
  const double begin = std::log(curve.seconds.front()), width = (std::log(curve.seconds.back()) - begin) / parts;
  const auto part_of = [&](std::size_t i) { return width > 0 ? std::floor((std::log(curve.seconds[i]) - begin) / width) : 0.0; };
  measure::Curve kept;
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    const double part = part_of(first);
    for (end = first + 1; end < count && part_of(end) == part;) ++end;
    const auto at = [&](std::size_t i) { return curve.errors.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [low, high] = std::minmax_element(at(first), at(end));
    std::array chosen{first, static_cast<std::size_t>(low - curve.errors.begin()), static_cast<std::size_t>(high - curve.errors.begin()),
                      end - 1};
    std::sort(chosen.begin(), chosen.end());
    const auto last = std::unique(chosen.begin(), chosen.end());
    for (auto i = chosen.begin(); i != last; ++i) {
      kept.seconds.push_back(curve.seconds[*i]);
      kept.errors.push_back(curve.errors[*i]);
    }
  }
  return kept;
}

ErrorLine line_of(const job::History& history, std::optional<std::size_t> column, double lowest_error)
{
  if (!column) return {};
  std::vector<double> seconds, errors;
  for (const job::HistoryRow& row : history.rows) {
    if (*column >= row.errors.size()) continue;
    seconds.push_back(row.seconds);
    errors.push_back(row.errors[*column]);
  }
  ErrorLine line;
  line.curve = measure::curve_of(seconds, errors);
  line.drawn = thinned(line.curve);
  line.fit = measure::fit_power_law(line.curve, lowest_error);
  return line;
}

/// The step at or below (above) a value, in eighths of a decade.
double step_below(double value) { return std::pow(10.0, std::floor(8 * std::log10(value)) / 8); }
double step_above(double value) { return std::pow(10.0, std::ceil(8 * std::log10(value)) / 8); }

} // namespace

std::string metric_of(const std::string& column) { return column.starts_with(estimated) ? column.substr(estimated.size()) : column; }

std::vector<std::string> metrics_of(const job::History& history)
{
  std::vector<std::string> metrics;
  for (const std::string& column : history.columns)
    if (const std::string metric = metric_of(column); std::find(metrics.begin(), metrics.end(), metric) == metrics.end())
      metrics.push_back(metric);
  return metrics;
}

RunLines lines_of(const job::History& history, const std::string& metric)
{
  RunLines lines;
  const auto column = column_of(history, metric);
  if (column && *column < history.noise_floor.size() && history.noise_floor[*column] > 0) lines.noise_floor = history.noise_floor[*column];
  lines.error = line_of(history, column, floors_above * lines.noise_floor.value_or(0));
  lines.estimate = line_of(history, column_of(history, std::string(estimated) + metric), 0);
  return lines;
}

std::optional<measure::EqualError> speed_up(const RunLines& pinned, const RunLines& run)
{
  const bool both_have_errors = !pinned.error.curve.seconds.empty() && !run.error.curve.seconds.empty();
  const measure::Curve& a = both_have_errors ? pinned.error.curve : pinned.estimate.curve;
  const measure::Curve& b = both_have_errors ? run.error.curve : run.estimate.curve;
  const double floor = both_have_errors ? std::max(pinned.noise_floor.value_or(0), run.noise_floor.value_or(0)) : 0;
  const auto both = measure::errors_both_reached(a, b, floors_above * floor);
  if (!both) return std::nullopt;
  return measure::at_equal_error(a, b, both->lowest);
}

std::optional<CurvePoint> nearest_point(const measure::Curve& curve, double seconds)
{
  if (curve.seconds.empty()) return std::nullopt;
  const auto after = std::lower_bound(curve.seconds.begin(), curve.seconds.end(), seconds);
  std::size_t index = std::min(static_cast<std::size_t>(after - curve.seconds.begin()), curve.seconds.size() - 1);
  if (index > 0 && seconds / curve.seconds[index - 1] < curve.seconds[index] / seconds) --index;
  return CurvePoint{curve.seconds[index], curve.errors[index]};
}

PlotRange plot_range(std::span<const RunLines* const> runs, std::span<const double> extra_errors)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  std::array<double, 2> seconds{none, 0}, errors{none, 0};
  const auto widen = [](std::array<double, 2>& range, double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (const RunLines* run : runs)
    for (const ErrorLine* line : {&run->error, &run->estimate}) {
      for (const double value : line->drawn.seconds) widen(seconds, value);
      for (const double value : line->drawn.errors) widen(errors, value);
    }
  if (errors[1] > 0)
    for (const double value : extra_errors) widen(errors, value);
  PlotRange range;
  if (seconds[1] > 0) range.seconds = {step_below(seconds[0] / 1.1), step_above(seconds[1] * 1.1)};
  if (errors[1] > 0) range.errors = {step_below(errors[0] / 1.3), step_above(errors[1] * 1.3)};
  return range;
}

std::string plot_csv(std::span<const NamedLines> runs, std::optional<double> target)
{
  // A name in quotes, as RFC 4180 has them.
  const auto quoted = [](const std::string& name) {
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + '"';
  };
  std::string csv = "run,line,seconds,error\n";
  for (const NamedLines& run : runs) {
    const auto add = [&](const char* line, const measure::Curve& curve) {
      for (std::size_t i = 0; i < curve.seconds.size(); ++i)
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", quoted(run.name), line, curve.seconds[i], curve.errors[i]);
    };
    add("error", run.lines->error.curve);
    add("estimate", run.lines->estimate.curve);
    if (run.lines->noise_floor) csv += fmt::format("{},noise floor,,{}\n", quoted(run.name), *run.lines->noise_floor);
  }
  if (target) csv += fmt::format(",target,,{}\n", *target);
  return csv;
}

} // namespace nephroid::ui
