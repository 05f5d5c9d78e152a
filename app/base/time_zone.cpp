// SPDX-License-Identifier: Apache-2.0
#include "base/time_zone.h"

#include "base/error.h"

#include <date/tz.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

namespace nephroid {
namespace {

const date::tzdb& zones() {
  try {
    return date::get_tzdb(); // read once
  } catch (const std::runtime_error& error) {
    throw failed("the system's time zones", error.what(), "expected those of the package tzdata");
  }
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
