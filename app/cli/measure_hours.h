// SPDX-License-Identifier: Apache-2.0
// `nephroid measure --hours`: the meters of a preset in the skies of a day, a year or a weather file.
#pragma once
#include "mpi/rank_context.h"
#include "run/prepare.h"

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

namespace nephroid::cli {

struct HoursOptions {
  std::string which;            ///< day, year, or a file
  std::string meter;            ///< empty: all
  std::filesystem::path folder; ///< empty: no files
  std::optional<int> every;     ///< days; nothing: 7
  std::optional<double> seconds, until_percent;
  bool json = false;
};

/// Throws bad_input where the preset's environment is no sky with a place, as scene::read_weather and run::Metering;
/// interrupted, after what was measured until then is told.
void measure_hours(const HoursOptions& options, const run::Prepared& prepared, const mpi::RankContext& context,
                   const std::stop_token& interrupted);

} // namespace nephroid::cli
