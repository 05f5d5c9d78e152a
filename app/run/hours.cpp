// SPDX-License-Identifier: Apache-2.0
#include "run/hours.h"

#include "base/counted.h"
#include "preset/place.h"
#include "scene/clear_sky.h"

#include <fmt/format.h>

#include <chrono>

namespace nephroid::run {
namespace {

using std::chrono::days;
using std::chrono::sys_days;

constexpr sys_days first_day{std::chrono::year{2000} / 1 / 1};

/// W/m^2 of the sun above the air in January, when it is nearest (1361 of Kopp and Lean 2011, times 1.035).
constexpr double above_the_air = 1408;

/// Of the days from 2000-01-01.
std::string date_of(int day) {
  const std::chrono::year_month_day date(first_day + days(day));
  return fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()), unsigned(date.day()));
}

void add_day(Hours& hours, const std::string& date) {
  preset::PlaceAndTime then = hours.place;
  then.date = date;
  for (int hour = 0; hour < 24; ++hour) {
    then.hour = hour;
    for (const double offset : preset::offsets_h(then)) hours.hours.push_back({date, then.hour, {}, {}, offset});
  }
}

std::string every_day(int every) { return every == 1 ? "each day" : fmt::format("every {}th day", every); }

std::string year_of(const preset::PlaceAndTime& place) { return place.date.substr(0, 4); }

/// What an hour stands for where so many days of all are taken.
double weight_of(std::size_t there_are, std::size_t taken) {
  return static_cast<double>(there_are) / static_cast<double>(taken);
}

} // namespace

Hours hours_of_day(const preset::PlaceAndTime& place) {
  Hours hours{.about = place.date, .place = place};
  add_day(hours, place.date);
  return hours;
}

Hours hours_of_year(const preset::PlaceAndTime& place, int every) {
  const std::string year = year_of(place);
  Hours hours{.about = every_day(every) + " of " + year, .place = place};
  const int first = preset::days_since_2000(year + "-01-01").value(),
            last = preset::days_since_2000(year + "-12-31").value(), days_of_year = last - first + 1;
  for (int day = first; day <= last; day += every) add_day(hours, date_of(day));
  hours.weight_h =
      weight_of(static_cast<std::size_t>(days_of_year), static_cast<std::size_t>((days_of_year + every - 1) / every));
  return hours;
}

Hours hours_of_weather(const scene::Weather& weather, const preset::PlaceAndTime& place, int every) {
  const std::size_t days = weather.hours.size() / 24, step = static_cast<std::size_t>(every);
  const bool is_year = days == 365 || days == 366;
  Hours hours{.about = every_day(every) +
                       (is_year ? " of the weather of " : " of the " + counted(days, "day") + " of weather of ") +
                       weather.place,
              .place = {.latitude_deg = weather.latitude_deg,
                        .longitude_deg = weather.longitude_deg,
                        .date = place.date,
                        .utc_offset_h = weather.utc_offset_h}};
  hours.weight_h = weight_of(days, (days + step - 1) / step);
  for (std::size_t i = 0; i < weather.hours.size(); ++i) {
    const scene::WeatherHour& hour = weather.hours[i];
    if (i / 24 % step != 0) continue;
    preset::PlaceAndTime then = hours.place;
    then.date = fmt::format("{}-{:02}-{:02}", year_of(place), hour.month, hour.day);
    then.hour = hour.hour;
    if (!preset::days_since_2000(then.date)) continue; // 29 February, where the preset's year has none
    if (!hour.direct_w || !hour.diffuse_w)
      ++hours.missing;
    else if (scene::sun_place(then).elevation_deg <= 0)
      hours.twilight += *hour.direct_w + *hour.diffuse_w > 0 ? 1 : 0;
    else {
      hours.too_bright += *hour.direct_w > above_the_air ? 1 : 0;
      hours.hours.push_back({then.date, hour.hour, hour.direct_w, hour.diffuse_w, weather.utc_offset_h});
    }
  }
  return hours;
}

preset::Environment sky_of(const preset::Environment& sky, const preset::PlaceAndTime& place, const Hour& hour) {
  preset::Environment made = sky;
  made.place = place;
  made.place->date = hour.date;
  made.place->hour = hour.hour;
  made.place->utc_offset_h = hour.utc_offset_h;
  made.place->time_zone.reset();
  if (!hour.direct_w || scene::is_night(made)) return made;
  const scene::ClearSky clear = scene::clear_sky_of(made, optics::SpectralRange::solar);
  made.sun_scale = *hour.direct_w / optics::sum_of(clear.direct);
  made.radiance = *hour.diffuse_w / optics::sum_of(clear.diffuse);
  made.lights = true;
  return made;
}

bool is_dark(const preset::Environment& sky) {
  return scene::is_night(sky) || (sky.sun_scale == 0 && sky.radiance == 0);
}

} // namespace nephroid::run
