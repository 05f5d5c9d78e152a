// SPDX-License-Identifier: Apache-2.0
// The checks by subject, in the order in which they make sense: a device whose exp is wrong needs no look at its prism.
#pragma once
#include "check/check.h"

#include <vector>

namespace nephroid::check {

using Checks = std::vector<Check>;

Checks arithmetic_checks(); ///< arithmetic.cpp: the device's own functions, in units in the last place
Checks exactness_checks();  ///< exactness.cpp: random numbers and sums, bit for bit
Checks geometry_checks();   ///< geometry.cpp: rays and triangles
Checks interface_checks();  ///< interfaces.cpp: Snell, Fresnel, nested media
Checks spectral_checks();   ///< spectra.cpp: sums over wavelengths, absorption
Checks emission_checks();   ///< emission.cpp: what lights send
Checks radiometry_checks(); ///< radiometry.cpp: small pictures against closed forms of irradiance and power
Checks refraction_checks(); ///< refraction.cpp: plates, a prism and a ball lens

} // namespace nephroid::check
