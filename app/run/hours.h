// SPDX-License-Identifier: Apache-2.0
// The hours of a day, of a year or of a weather file, each a sky of its own for the meters of a preset.
#pragma once
#include "preset/preset.h"
#include "scene/sky.h"
#include "scene/weather.h"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::run {

struct Hour {
  std::string date;                          ///< as preset::PlaceAndTime has it
  double hour = 0;                           ///< by the place's clock
  std::optional<double> direct_w, diffuse_w; ///< W/m^2 as scene::WeatherHour has them; nothing: a clear sky's
  double utc_offset_h = 0;                   ///< what that clock is ahead of UTC
};

/// A series of hours at a place. Each stands for `weight_h` of the time that the series is of.
struct Hours {
  std::string about; ///< "2026-06-21", "every 7th day of 2026", "every 7th day of London.epw"
  preset::PlaceAndTime place;
  double weight_h = 1;
  int missing = 0;  ///< hours that a weather file has no data for; they are left out
  int twilight = 0; ///< hours with light in the file whose sun is below the horizon in their middle; they are left out
  int too_bright = 0; ///< hours whose sun is brighter than above the air; they are measured
  std::vector<Hour> hours = {};
};

/// Each full hour of the place's day. One that its clock shows twice is there twice, one that it never shows is not.
Hours hours_of_day(const preset::PlaceAndTime& place);
/// Each full hour of every `every`th day of the place's year, from 1 January. every: 1..365.
Hours hours_of_year(const preset::PlaceAndTime& place, int every);
/// The hours of every `every`th day of the weather, in the year of `place`. Its place is the weather's.
Hours hours_of_weather(const scene::Weather& weather, const preset::PlaceAndTime& place, int every);

/// The sky of an hour. sky: has a place. Of weather it gives what the hour says, and is a light; else it is as bright
/// as a clear one, times its radiance and sun_scale.
preset::Environment sky_of(const preset::Environment& sky, const preset::PlaceAndTime& place, const Hour& hour);

/// Whether neither the sun nor the sky has light.
bool is_dark(const preset::Environment& sky);

} // namespace nephroid::run
