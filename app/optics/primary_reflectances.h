// SPDX-License-Identifier: Apache-2.0
// Reflectances of surfaces that are known by their colour alone.
#pragma once
#include "optics/wavelength.h"

#include <array>

namespace nephroid::optics {

/// The reflectances of a red, a green and a blue surface. Under D65 they have the colours of sRGB's primaries, their
/// sum is 1 at every wavelength, and each is within 0..1. So r, g, b in 0..1 times these is a reflectance within 0..1
/// which under D65 has the linear sRGB colour (r, g, b), as Mallett and Yuksel (2019, "Spectral Primary Decomposition
/// for Rendering with sRGB Reflectance") have it.
/// In the solar range their values at 380 and 780 nm are held beyond.
const std::array<Spectrum, 3>& primary_reflectances(SpectralRange range = SpectralRange::visible);

} // namespace nephroid::optics
