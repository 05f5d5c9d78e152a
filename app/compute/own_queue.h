// SPDX-License-Identifier: Apache-2.0
// A second thread on a device that is open.
#pragma once
#include "compute/compute.h"

namespace nephroid::compute {

/// The same device with a queue and programs of its own, for one other thread. Both share OpenCL's context: PoCL
/// compiles one kernel of a context at a time. Throws failed where the device has no further queue.
Context with_own_queue(const Context& context);

} // namespace nephroid::compute
