// SPDX-License-Identifier: Apache-2.0
// The checks of any engine by subject, in the order in which they make sense: a device whose exp is wrong needs no look at its rays.
#pragma once
#include "check/check.h"

#include <vector>

namespace nephroid::check {

using Checks = std::vector<Check>;

Checks arithmetic_checks(); ///< arithmetic.cpp: the device's own functions, in units in the last place
Checks exactness_checks();  ///< exactness.cpp: random numbers and sums, bit for bit
Checks geometry_checks();   ///< geometry.cpp: rays and triangles
Checks interface_checks();  ///< interfaces.cpp: Snell, Fresnel, nested media

} // namespace nephroid::check
