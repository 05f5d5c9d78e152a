// SPDX-License-Identifier: Apache-2.0
// Colour: the CIE 1931 2-degree functions, XYZ, linear sRGB, CIELAB. Figures: CIE 015, IEC 61966-2-1.
#pragma once
#include "optics/wavelength.h"

#include <array>

namespace nephroid::optics {

using Colour = std::array<double, 3>;

struct ColourMatching {
  Spectrum x, y, z;
};
const ColourMatching& cie_1931();

/// Sum over wavelengths of spectrum times (xbar, ybar, zbar), times 1 nm; no factor 683.
Colour to_xyz(const Spectrum& spectrum);
/// Inverse of the four-digit IEC matrix, no adaptation, no clipping.
Colour xyz_to_linear_srgb(const Colour& xyz);
Colour linear_srgb_to_xyz(const Colour& rgb);
/// sRGB encoding of one channel; negative values are mirrored.
double srgb_encode(double linear);
/// CIELAB with the D65 white of xy .3127 / .3290 and Y = 1.
Colour xyz_to_lab(const Colour& xyz);
/// CIE lightness L* (0..100) of a relative luminance Y / Yn.
double lightness(double relative_luminance);

} // namespace nephroid::optics
