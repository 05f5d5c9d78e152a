// SPDX-License-Identifier: Apache-2.0
// From a colour to a spectrum that has it: needed where light that is known by its colour alone meets glass, which bends and absorbs
// each wavelength its own way.
#pragma once
#include "optics/wavelength.h"

#include <array>

namespace nephroid::optics {

/// The smoothest spectra of the three linear sRGB primaries: of all that to_xyz() takes to the primary's XYZ, those with the smallest sum
/// of squared second differences. Smoothness is linear, so r, g, b times these is the smoothest spectrum of the colour (r, g, b). They
/// are negative here and there, as every spectrum of a primary would be that is as smooth.
const std::array<Spectrum, 3>& primary_spectra();

} // namespace nephroid::optics
