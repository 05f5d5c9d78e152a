// SPDX-License-Identifier: Apache-2.0
#include "base/time_zone.h"

#include "base/error.h"

#include <date/tz.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

namespace nephroid {
namespace {

/// Files of zones list their changes. Those of the kind 'slim' end early, and the library would take the last offset.
constexpr date::sys_days summer_of_last_year = date::year{2037} / 6 / 21;

const date::tzdb& zones() {
  try {
    const date::tzdb& all = date::get_tzdb(); // read once
    static const bool has_rules =
        date::locate_zone(std::string("Europe/London"))->get_info(summer_of_last_year).offset.count() > 0;
    if (has_rules) return all;
  } catch (const std::runtime_error& error) {
    throw failed("the system's time zones", error.what(), "expected those of the package tzdata");
  }
  throw failed("the system's time zones", "have no summer time in 2037", "expected files of the kind 'fat'",
               "give the sky's utc_offset_h in place of its time_zone");
}

double hours_of(const date::sys_info& info) { return static_cast<double>(info.offset.count()) / 3600; }

} // namespace

std::vector<std::string> time_zone_names() {
  std::vector<std::string> names;
  for (const date::time_zone& zone : zones().zones) names.push_back(zone.name());
  return names;
}

ClockOffsets clock_offsets(const std::string& zone, int days_since_2000, double hour) {
  const date::local_seconds shown = date::local_days{date::year{2000} / 1 / 1} + date::days{days_since_2000} +
                                    std::chrono::seconds{std::llround(3600 * hour)};
  const date::local_info info = date::locate_zone(zone)->get_info(shown);
  if (info.result == date::local_info::unique) return {1, hours_of(info.first), hours_of(info.first)};
  return {info.result == date::local_info::ambiguous ? 2 : 0, hours_of(info.first), hours_of(info.second)};
}

} // namespace nephroid
