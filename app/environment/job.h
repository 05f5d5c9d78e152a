// SPDX-License-Identifier: Apache-2.0
// The job of engine 2: the object is baked, or its bake is read; then the scene is rendered.
#pragma once
#include "environment/plan.h"
#include "job/job.h"
#include "mpi/rank_context.h"

#include <memory>

namespace nephroid::environment {

/// Reads the bake where the plan has one, else bakes. Then renders until the preset's stop. Without light the job only
/// bakes, and a pass of the stop is a direction. Throws failed where the device has not enough memory.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const EnvironmentPlan& plan,
                                   const mpi::RankContext& context);

} // namespace nephroid::environment
