// SPDX-License-Identifier: Apache-2.0
// How fast a job goes, and how long it will take.
#pragma once
#include "job/job.h"

#include <string>

namespace nephroid::job {

/// From how much was done and how long it took in this session: a resumed run goes at this session's speed.
struct Pace {
  double work_per_second = 0;
  double seconds_left = -1; ///< -1: not known yet
};
Pace pace_between(const Progress& start, const Progress& now);
/// "1.21 M photons/s": three figures, in the engine's units.
std::string rate_text(const Pace& pace, const Units& units);

} // namespace nephroid::job
