// SPDX-License-Identifier: Apache-2.0
#include "job/pace.h"

#include <algorithm>

namespace nephroid::job {

Pace pace_between(const Progress& start, const Progress& now)
{
  Pace pace;
  const double seconds = now.work_seconds - start.work_seconds, fraction = now.fraction - start.fraction;
  if (seconds <= 0) return pace;
  pace.work_per_second = static_cast<double>(now.work - start.work) / seconds;
  if (fraction > 0) pace.seconds_left = std::max(0.0, seconds * (1 - now.fraction) / fraction);
  return pace;
}

} // namespace nephroid::job
