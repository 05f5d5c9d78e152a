// SPDX-License-Identifier: Apache-2.0
#include "job/pace.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::job {

Pace pace_between(const Progress& start, const Progress& now) {
  Pace pace;
  const double seconds = now.work_seconds - start.work_seconds, fraction = now.fraction - start.fraction;
  if (seconds <= 0) return pace;
  pace.work_per_second = static_cast<double>(now.work - start.work) / seconds;
  if (fraction > 0 && now.fraction >= 0.005) // the first steps are not typical
    pace.seconds_left = std::max(0.0, seconds * (1 - now.fraction) / fraction);
  return pace;
}

std::string rate_text(const Pace& pace, const Units& units) {
  const char* const prefixes[] = {"", "k ", "M ", "G ", "T "};
  double rate = pace.work_per_second;
  int prefix = 0;
  for (; rate >= 1000 && prefix < 4; ++prefix) rate /= 1000;
  return fmt::format("{:.{}f} {}{}/s", rate, rate < 10 ? 2 : rate < 100 ? 1 : 0, prefixes[prefix], units.works);
}

} // namespace nephroid::job
