// SPDX-License-Identifier: Apache-2.0
// A job beside which the preset's meters measure: what they show is in its snapshots.
#pragma once
#include "run/prepare.h"

#include <atomic>
#include <memory>

namespace nephroid::run {

/// The part of a run's time that its meters have, where nobody looks at them.
inline constexpr double usual_meter_share = 0.03;

/// The part that they have now, 0..0.9; who looks at them may change it. Null: usual_meter_share.
using MeterShare = std::shared_ptr<const std::atomic<double>>;

/// The job itself where the preset has no meters. Else they begin after its first pass, and each has a reading before
/// the job is finished: of that the last part may take more than their share. Their time is not the picture's: it is
/// not in Progress::work_seconds. Its picture has the same bits as without them. Throws as check_meters.
std::unique_ptr<job::Job> metered(std::unique_ptr<job::Job> job, const Prepared& prepared,
                                  const mpi::RankContext& context, MeterShare share);

} // namespace nephroid::run
