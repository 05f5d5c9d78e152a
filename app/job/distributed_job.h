// SPDX-License-Identifier: Apache-2.0
// A job that the ranks do together: each has one of its own, rank 0's says what is next, the others' follow.
#pragma once
#include "base/communicator.h"
#include "job/job.h"

#include <memory>

namespace nephroid::job {

/// Rank 0's: passes every call on to the others. They are let go when it is destroyed. It takes no other preset on
/// (Job::adopt).
std::unique_ptr<Job> distributed(std::unique_ptr<Job> job, const Communicator& communicator);

/// Another rank's: makes the calls that rank 0 makes of its job, until that lets go. What this one's pictures show is
/// nobody's business.
void follow_root(Job& job, const Communicator& communicator);

} // namespace nephroid::job
