// SPDX-License-Identifier: Apache-2.0
// Colour: the CIE 1931 2-degree functions, XYZ, linear sRGB, lightness. Figures: CIE 015, IEC 61966-2-1.
#pragma once
#include "optics/wavelength.h"

#include <array>

namespace nephroid::optics {

using Colour = std::array<double, 3>;

struct ColourMatching {
  Spectrum x, y, z;
};
const ColourMatching& cie_1931();
/// What a meter makes of light in their place: x its power, y as they have it, z 0.
const ColourMatching& power_and_luminance(SpectralRange range);

/// Sum over wavelengths of spectrum times (xbar, ybar, zbar), times 1 nm; no factor 683.
Colour to_xyz(const Spectrum& spectrum);
/// Inverse of the four-digit IEC matrix, no adaptation, no clipping.
Colour xyz_to_linear_srgb(const Colour& xyz);
Colour linear_srgb_to_xyz(const Colour& rgb);
/// sRGB encoding of one channel; negative values are mirrored.
double srgb_encode(double linear);
/// From linear sRGB to the same, [row][column]: a white with this XYZ becomes grey of its Y, other colours follow by
/// the Bradford transform (Lam 1985; ICC.1:2022, annex E). A cone that sees less than a fiftieth of what it sees of D65
/// is taken to see that, as of a glow of 1000 K.
std::array<Colour, 3> white_balance(const Colour& white_xyz);
/// CIE lightness L* (0..100) of a relative luminance Y / Yn.
double lightness(double relative_luminance);

/// Spectra for light that is known by its colour alone and meets glass: the smoothest ones of the three linear sRGB
/// primaries, of all with their XYZ those with the smallest sum of squared second differences. Smoothness is linear, so
/// r, g, b times these is the smoothest spectrum of the colour (r, g, b). They are negative here and there.
/// In the solar range they have nothing beyond 380..780 nm.
const std::array<Spectrum, 3>& primary_spectra(SpectralRange range = SpectralRange::visible);

/// A spectrum of light of a colour in linear sRGB, of which no part is negative and one is not 0: the smoothest one
/// where that is negative nowhere, else one whose logarithm is smooth.
Spectrum light_of_colour(const Colour& rgb);

} // namespace nephroid::optics
