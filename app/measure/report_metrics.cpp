// SPDX-License-Identifier: Apache-2.0
#include "measure/report_metrics.h"

#include <map>

namespace nephroid::measure {
namespace {

constexpr std::string_view estimated = "estimated_", masked = "masked_";

const std::map<std::string, MetricText, std::less<>>& texts()
{
  // A distance falls with the root of the samples, a mean square with their number. FLIP bends small differences upwards by a power.
  static const std::map<std::string, MetricText, std::less<>> all{
      {"lab_mean", {"mean CIELAB distance", "CIELAB units", -0.5}},
      {"lab_rms", {"root mean square CIELAB distance", "CIELAB units", -0.5}},
      {"lab_max", {"largest CIELAB distance", "CIELAB units", -0.5}},
      {"mse", {"mean square error", "white²", -1.0}},
      {"rel_mse", {"relative mean square error", "", -1.0}},
      {"rel_l2", {"relative L2 error", "", -0.5}},
      {"psnr_db", {"peak signal-to-noise ratio", "dB", std::nullopt, false}},
      {"iw_ssim", {"IW-SSIM", "", std::nullopt, false}},
      {"flip", {"FLIP", "", std::nullopt}},
      {"hdr_flip", {"HDR-FLIP", "", std::nullopt}},
  };
  return all;
}

} // namespace

ErrorColumn error_column_of(std::string_view column)
{
  if (column.starts_with(estimated)) return {std::string(column.substr(estimated.size())), true};
  return {std::string(column), false};
}

std::string column_name(const ErrorColumn& column) { return (column.is_estimate ? std::string(estimated) : "") + column.metric; }

MetricText metric_text(std::string_view metric)
{
  if (metric.starts_with(masked)) {
    MetricText text = metric_text(metric.substr(masked.size()));
    text.label += ", inside the mask";
    return text;
  }
  const auto known = texts().find(metric);
  return known == texts().end() ? MetricText{std::string(metric), "", std::nullopt, true} : known->second;
}

} // namespace nephroid::measure
