// SPDX-License-Identifier: Apache-2.0
// Who waits for kernels to be compiled is told so: the first run with a new option takes seconds to begin.
#pragma once
#include "compute/compute.h"

#include <functional>

namespace nephroid::compute {

/// From here on tell() is called before the context compiles a kernel source, by the thread that uses it, and not for programs that it has
/// already. OpenCL may go on compiling until each kernel has run once.
void tell_of_compiling(const Context& context, std::function<void()> tell);

} // namespace nephroid::compute
