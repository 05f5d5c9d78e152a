// SPDX-License-Identifier: Apache-2.0
// Weather files of EnergyPlus (EPW): the sun and the sky of each hour of a year at a place.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::scene {

struct WeatherHour {
  int month = 1, day = 1;                    ///< by the clock of Weather::utc_offset_h
  double hour = 0.5;                         ///< the middle of the hour: 0.5 to 23.5
  std::optional<double> direct_w, diffuse_w; ///< W/m^2 on a plane that faces the sun, and of the sky on a level one;
                                             ///< nothing where the file has none
};

struct Weather {
  std::string place;
  double latitude_deg = 0, longitude_deg = 0, utc_offset_h = 0; ///< without summer time
  std::vector<WeatherHour> hours;                               ///< in order
};

/// Throws bad_input at the file's line for what is no EPW file, for a file of parts of an hour, and where hours lack or
/// are out of order; failed where it cannot be read.
Weather read_weather(const std::filesystem::path& file);

} // namespace nephroid::scene
