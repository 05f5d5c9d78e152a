// SPDX-License-Identifier: Apache-2.0
// What the panel "Error" draws of a history: curves of one metric with their slopes. No Dear ImGui.
#pragma once
#include "job/history.h"
#include "measure/run_curves.h"

#include <array>

namespace nephroid::ui {

struct ErrorLine {
  measure::Curve curve;                 ///< every row that has a logarithm; empty where the history has no such column
  measure::Curve drawn;                 ///< a few points a pixel of it
  std::optional<measure::PowerLaw> fit; ///< over the rows above the noise floor
};

/// One run's lines of one metric.
struct RunLines {
  ErrorLine error;    ///< against the reference
  ErrorLine estimate; ///< the run's own, which needs no reference
  std::optional<double> noise_floor;
  double lowest_meaningful = 0; ///< errors below it are too near to the noise floor to be compared
  bool falls = true;            ///< false: larger is better (psnr_db), on a linear axis; no slopes then, no speed-ups

  bool empty() const { return error.curve.seconds.empty() && estimate.curve.seconds.empty(); }
  /// The line that the run is judged by: the error, without a reference the estimate.
  const ErrorLine& judged() const { return error.curve.seconds.empty() ? estimate : error; }
};

RunLines lines_of(const job::History& history, const std::string& metric);

struct SpeedUp : measure::EqualError {
  bool by_estimate = false;
};
/// How much faster `run` came to the lowest error that both came to, well above the noise floor; nothing where there is
/// none. Estimates are held against estimates, errors against errors.
std::optional<SpeedUp> speed_up(const RunLines& pinned, const RunLines& run);

/// The point nearest in log time; nothing for an empty curve.
struct CurvePoint {
  double seconds = 0, error = 0;
};
std::optional<CurvePoint> nearest_point(const measure::Curve& curve, double seconds);

/// Ends of the axes (seconds on a log axis, errors on one where they fall): all points of all curves and the extra
/// errors (a floor, a target) with some room, in steps of an eighth of a decade, so that the axes of a growing curve
/// rest most of the time, and at least half a decade. One decade each where there is nothing.
struct PlotRange {
  std::array<double, 2> seconds{0.1, 1}, errors{0.1, 1};
};
PlotRange plot_range(std::span<const RunLines* const> runs, std::span<const double> extra_errors);

/// Where an axis has numbers: 1, 2 and 5 times powers of ten, or powers of ten alone where that were too many.
std::vector<double> axis_ticks(const std::array<double, 2>& ends);

/// "run,line,seconds,error" of what the plot shows, every row.
struct NamedLines {
  std::string name;
  RunLines lines;
};
std::string plot_csv(std::span<const NamedLines> runs, std::optional<double> target);

} // namespace nephroid::ui
