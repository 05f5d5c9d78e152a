// SPDX-License-Identifier: Apache-2.0
// A job that measures itself: it steps another job, now and then compares its picture with a reference or with itself, keeps the
// history and ends at the error that was asked for. The command line and the window get the same history by the same means.
#pragma once
#include "job/job.h"
#include "measure/reference.h"
#include "preset/preset.h"

#include <chrono>
#include <memory>
#include <vector>

namespace nephroid::measure {

/// At most so much of the work's time is spent on measuring, the first and the last measurement excepted.
inline constexpr double measuring_share = 0.04;

/// Wraps a job. reference: null where there is none. began: when the run's wall clock started. Measurements come at times that grow by
/// a fifth, and where stop.error is about to be reached; a step measures or works, never both, and measuring is not in
/// Progress::work_seconds. Throws bad_input where stop.error is asked for with neither a reference nor an estimate. The reference
/// has the picture's size. times: of work, in order, at which to measure besides.
std::unique_ptr<job::Job> measured(std::unique_ptr<job::Job> job, const preset::Preset& preset, std::shared_ptr<const Reference> reference,
                                   std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now(),
                                   std::vector<double> times = {});

} // namespace nephroid::measure
