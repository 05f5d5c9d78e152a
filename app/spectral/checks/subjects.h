// SPDX-License-Identifier: Apache-2.0
// The checks of engine 1 by subject: its tables, its lights, and small pictures against closed forms.
#pragma once
#include "check/check.h"

#include <vector>

namespace nephroid::check {

using Checks = std::vector<Check>;

Checks spectral_checks();   ///< spectra.cpp: sums over wavelengths, absorption
Checks emission_checks();   ///< emission.cpp: what lights send
Checks radiometry_checks(); ///< radiometry.cpp: small pictures against closed forms of irradiance and power
Checks refraction_checks(); ///< refraction.cpp: plates, a prism and a ball lens

} // namespace nephroid::check
