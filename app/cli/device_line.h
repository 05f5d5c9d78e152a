// SPDX-License-Identifier: Apache-2.0
// How a device is shown on one line (devices.cpp has it).
#pragma once
#include "compute/compute.h"

#include <string>

namespace nephroid::cli {

/// "0  NAME  (cpu, 2 compute units, 8.1 GB, PLATFORM DRIVER, no fp64)"
std::string device_line(const compute::DeviceInfo& device);

} // namespace nephroid::cli
