// SPDX-License-Identifier: Apache-2.0
#include "ui/error/lines.h"

#include "ui/widgets/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace nephroid::ui {
namespace {

/// At most four points in each of 500 parts of the log time axis: the first, the lowest, the highest, the last. A plot
/// is about as many pixels wide.
measure::Curve thinned(const measure::Curve& curve) {
  constexpr double parts = 500;
  const std::size_t count = curve.seconds.size();
  if (count < 4 * static_cast<std::size_t>(parts)) return curve;
  const double begin = std::log(curve.seconds.front()), width = (std::log(curve.seconds.back()) - begin) / parts;
  const auto part_of = [&](std::size_t i) {
    return width > 0 ? std::floor((std::log(curve.seconds[i]) - begin) / width) : 0.0;
  };
  measure::Curve kept;
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    const double part = part_of(first);
    for (end = first + 1; end < count && part_of(end) == part;) ++end;
    const auto at = [&](std::size_t i) { return curve.errors.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto [low, high] = std::minmax_element(at(first), at(end));
    std::array chosen{first, static_cast<std::size_t>(low - curve.errors.begin()),
                      static_cast<std::size_t>(high - curve.errors.begin()), end - 1};
    std::sort(chosen.begin(), chosen.end());
    const auto last = std::unique(chosen.begin(), chosen.end());
    for (auto i = chosen.begin(); i != last; ++i) {
      kept.seconds.push_back(curve.seconds[*i]);
      kept.errors.push_back(curve.errors[*i]);
    }
  }
  return kept;
}

/// The step at or below (above) a value, in eighths of a decade.
double step_below(double value) { return std::pow(10.0, std::floor(8 * std::log10(value)) / 8); }
double step_above(double value) { return std::pow(10.0, std::ceil(8 * std::log10(value)) / 8); }

/// The ends of an axis that shows all of values (infinity, 0: none), at least half a decade.
std::array<double, 2> axis_ends(const std::array<double, 2>& values, double room,
                                const std::array<double, 2>& without) {
  if (!(values[1] > 0)) return without;
  const double low = std::min(values[0] / room, std::sqrt(values[0] * values[1] / 3)),
               high = std::max(values[1] * room, low * 3);
  return {step_below(low), step_above(high)};
}

} // namespace

RunLines lines_of(const job::History& history, const std::string& metric) {
  const measure::RunCurves curves = measure::run_curves(history, metric, measure::is_error(history, metric));
  RunLines lines;
  lines.falls = curves.falls;
  lines.error = {curves.error, thinned(curves.error), {}};
  lines.estimate = {curves.estimate, thinned(curves.estimate), {}};
  if (curves.noise_floor > 0) lines.noise_floor = curves.noise_floor;
  if (!lines.falls) return lines;
  // As the report has them: what is too near to the noise floor bends the line and is left out.
  if (!curves.is_judged_by_estimate()) lines.error.fit = curves.slope();
  lines.estimate.fit = measure::fit_power_law(curves.estimate);
  lines.lowest_meaningful = curves.lowest_meaningful();
  return lines;
}

std::optional<SpeedUp> speed_up(const RunLines& pinned, const RunLines& run) {
  if (!pinned.falls || !run.falls) return std::nullopt;
  const bool both_have_errors = !pinned.error.curve.seconds.empty() && !run.error.curve.seconds.empty();
  const measure::Curve& a = both_have_errors ? pinned.error.curve : pinned.estimate.curve;
  const measure::Curve& b = both_have_errors ? run.error.curve : run.estimate.curve;
  const double lowest = both_have_errors ? std::max(pinned.lowest_meaningful, run.lowest_meaningful) : 0;
  const auto both = measure::errors_both_reached(a, b, lowest);
  if (!both) return std::nullopt;
  const auto equal = measure::at_equal_error(a, b, both->lowest);
  return equal ? std::optional(SpeedUp{*equal, !both_have_errors}) : std::nullopt;
}

std::optional<CurvePoint> nearest_point(const measure::Curve& curve, double seconds) {
  if (curve.seconds.empty()) return std::nullopt;
  const auto after = std::lower_bound(curve.seconds.begin(), curve.seconds.end(), seconds);
  std::size_t index = std::min(static_cast<std::size_t>(after - curve.seconds.begin()), curve.seconds.size() - 1);
  if (index > 0 && seconds / curve.seconds[index - 1] < curve.seconds[index] / seconds) --index;
  return CurvePoint{curve.seconds[index], curve.errors[index]};
}

PlotRange plot_range(std::span<const RunLines* const> runs, std::span<const double> extra_errors) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const bool is_linear = std::any_of(runs.begin(), runs.end(), [](const RunLines* run) { return !run->falls; });
  std::array<double, 2> seconds{none, -none}, errors{none, -none};
  const auto widen = [](std::array<double, 2>& range, double value, bool is_log = true) {
    if (!std::isfinite(value) || (is_log && value <= 0)) return;
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (const RunLines* run : runs)
    for (const ErrorLine* line : {&run->error, &run->estimate}) {
      for (const double value : line->drawn.seconds) widen(seconds, value);
      for (const double value : line->drawn.errors) widen(errors, value, !is_linear);
    }
  const bool is_empty = errors[0] > errors[1];
  if (!is_empty)
    for (const double value : extra_errors) widen(errors, value, !is_linear);
  const PlotRange empty;
  if (is_linear && !is_empty) {
    const double room = std::max({0.1 * (errors[1] - errors[0]), 0.01 * std::abs(errors[1]), 1e-6});
    return {axis_ends(seconds, 1.1, empty.seconds), {errors[0] - room, errors[1] + room}};
  }
  return {axis_ends(seconds, 1.1, empty.seconds), axis_ends(errors, 1.3, empty.errors)};
}

std::vector<double> axis_ticks(const std::array<double, 2>& ends) {
  constexpr std::size_t most = 9;
  std::vector<double> ticks = measure::round_levels(ends[0], ends[1]);
  if (ticks.size() > most) {
    const double step = std::ceil(std::log10(ends[1] / ends[0]) / most); // whole decades
    std::erase_if(ticks, [&](double tick) {
      const double decades = std::log10(tick);
      return std::abs(decades / step - std::round(decades / step)) > 1e-6;
    });
  }
  if (ticks.size() < 2) ticks = {ends[0], std::sqrt(ends[0] * ends[1]), ends[1]}; // zoomed in between two round numbers
  return ticks;
}

std::string plot_csv(std::span<const NamedLines> runs, std::optional<double> target) {
  std::string csv = "run,line,seconds,error\n";
  for (const NamedLines& run : runs) {
    const auto add = [&](const char* line, const measure::Curve& curve) {
      for (std::size_t i = 0; i < curve.seconds.size(); ++i)
        fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", in_csv(run.name), line, curve.seconds[i],
                       curve.errors[i]);
    };
    add("error", run.lines.error.curve);
    add("estimate", run.lines.estimate.curve);
    if (run.lines.noise_floor) csv += fmt::format("{},noise floor,,{}\n", in_csv(run.name), *run.lines.noise_floor);
  }
  if (target) csv += fmt::format(",target,,{}\n", *target);
  return csv;
}

} // namespace nephroid::ui
