// SPDX-License-Identifier: Apache-2.0
// The clocks of time zones, by the names of IANA's data base ("Europe/London") and the data of the system. The only
// file that knows the date library.
#pragma once
#include <string>
#include <vector>

namespace nephroid {

/// The last year whose summer times are known: the library reads no rules for later ones.
inline constexpr int last_year_of_time_zones = 2037;

/// What clocks are ahead of UTC when they show a time, in hours.
struct ClockOffsets {
  int times = 1;       ///< how often they show it: 2 where they are set back, 0 where they are set forward past it
  double before_h = 0; ///< before the change
  double after_h = 0;  ///< after it; the same where there is none
};

/// All names, in order. Throws failed where the system has no data.
std::vector<std::string> time_zone_names();
/// zone: a known name. hour: 0..24, of so many days from 2000-01-01, to last_year_of_time_zones. Throws failed as
/// time_zone_names.
ClockOffsets clock_offsets(const std::string& zone, int days_since_2000, double hour);

} // namespace nephroid
