// SPDX-License-Identifier: Apache-2.0
#include "preset/place.h"

#include "base/error.h"
#include "base/nearest.h"
#include "base/numbers.h"
#include "base/time_zone.h"
#include "preset/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace nephroid::preset {

std::optional<int> days_since_2000(const std::string& date) {
  if (date.size() != 10 || date[4] != '-' || date[7] != '-') return std::nullopt;
  const auto year = number_in<int>(date.substr(0, 4)), month = number_in<int>(date.substr(5, 2)),
             day = number_in<int>(date.substr(8));
  if (!year || !month || !day || *year < 1950 || *year > 2050 || *month < 1 || *day < 1) return std::nullopt;
  const std::chrono::year_month_day there{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                          std::chrono::day(static_cast<unsigned>(*day))};
  if (!there.ok()) return std::nullopt;
  using namespace std::chrono_literals;
  return static_cast<int>((std::chrono::sys_days(there) - std::chrono::sys_days(2000y / 1 / 1)).count());
}

namespace {

ClockOffsets offsets_of(const PlaceAndTime& place) {
  const double offset = place.utc_offset_h.value_or(0);
  if (!place.time_zone) return {1, offset, offset};
  return clock_offsets(*place.time_zone, days_since_2000(place.date).value(), place.hour);
}

} // namespace

double offset_h(const PlaceAndTime& place) { return offsets_of(place).before_h; }

std::vector<double> offsets_h(const PlaceAndTime& place) {
  const ClockOffsets offsets = offsets_of(place);
  std::vector<double> all{offsets.before_h, offsets.after_h};
  all.resize(static_cast<std::size_t>(offsets.times));
  return all;
}

void check_place(const PlaceAndTime& place, const std::string& pointer, const Where& where) {
  if (!days_since_2000(place.date))
    throw bad_input(where(child(pointer, "date")), "is " + in_quotes(place.date),
                    "expected a day from 1950-01-01 to 2050-12-31 as YYYY-MM-DD");
  if (!place.time_zone) return;
  const Location at = where(child(pointer, "time_zone"));
  if (place.utc_offset_h) throw bad_input(at, "is given, and utc_offset_h besides", "expected one of them");
  const std::vector<std::string> known = time_zone_names();
  if (std::ranges::find(known, *place.time_zone) == known.end()) {
    const std::string similar = nearest(*place.time_zone, known);
    throw bad_input(at, fmt::format("there is no time zone {}", in_quotes(*place.time_zone)),
                    "expected a name such as 'Europe/London'",
                    similar.empty() ? "" : fmt::format("did you mean '{}'?", similar));
  }
  if (place.date.substr(0, 4) > std::to_string(last_year_of_time_zones))
    throw bad_input(at, fmt::format("has no known summer time on {}", place.date),
                    fmt::format("expected a date until {}", last_year_of_time_zones), "give utc_offset_h in its place");
}

} // namespace nephroid::preset
