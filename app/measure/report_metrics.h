// SPDX-License-Identifier: Apache-2.0
// What a report calls the columns of a history, and how it draws them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace nephroid::measure {

/// A column of a history taken apart: "estimated_lab_mean" is the estimate of "lab_mean"; a mask's metrics ("masked_lab_mean") are
/// metrics of their own.
struct ErrorColumn {
  std::string metric;
  bool is_estimate = false;
};
ErrorColumn error_column_of(std::string_view column);
/// And back.
std::string column_name(const ErrorColumn& column);

struct MetricText {
  std::string label; ///< "mean CIELAB distance"
  std::string unit;  ///< "CIELAB units", "dB"; empty: a ratio without one
  /// The error of n independent samples is in proportion to n to this power; none where there is no such law.
  std::optional<double> law;
  bool falls = true; ///< false: larger is better, and the axis is linear

  bool is_mean_square() const { return law == -1.0; }
};
/// Of a metric by its name; of an unknown one the name itself, as an error without unit and law.
MetricText metric_text(std::string_view metric);

} // namespace nephroid::measure
