// SPDX-License-Identifier: Apache-2.0
// A job that measures itself: it steps another job, now and then compares its picture with a reference or with itself, keeps the
// history and ends at the error that was asked for. The command line and the window get the same history by the same means.
#pragma once
#include "job/job.h"
#include "measure/reference.h"
#include "preset/preset.h"

#include <memory>

namespace nephroid::measure {

/// Wraps a job. reference: null where there is none. Measuring takes at most measuring_share of the work's time, the first and the
/// last measurement excepted, and its time is not in Progress::work_seconds. Throws bad_input where the reference has another size
/// than the picture, and where stop.error is asked for with neither a reference nor an estimate.
std::unique_ptr<job::Job> measured(std::unique_ptr<job::Job> job, const preset::Preset& preset, std::shared_ptr<const Reference> reference);

inline constexpr double measuring_share = 0.04;

} // namespace nephroid::measure
