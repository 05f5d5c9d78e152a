// SPDX-License-Identifier: Apache-2.0
// A run of engine 3: slopes, then the solid, then its judgement.
#pragma once
#include "inverse/plan.h"
#include "job/job.h"
#include "mpi/rank_context.h"

namespace nephroid::inverse {

/// Searches slopes until the method gains no more or until the preset's stop; then makes the solid and judges it.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const InversePlan& plan,
                                   const mpi::RankContext& context);

} // namespace nephroid::inverse
