// SPDX-License-Identifier: Apache-2.0
// A job that the ranks do together: each has one of its own, rank 0's says what is next, the others' follow.
#pragma once
#include "base/communicator.h"
#include "job/job.h"

#include <memory>

namespace nephroid::job {

/// The root's job: passes every call on to the other ranks, until it is destroyed. It adopts no other preset.
std::unique_ptr<Job> distributed(std::unique_ptr<Job> job, const Communicator& communicator);

/// Makes the calls on another rank's job that the root makes on its own, until the root's is destroyed.
void follow_root(Job& job, const Communicator& communicator);

} // namespace nephroid::job
