// SPDX-License-Identifier: Apache-2.0
// Light spectra and reflectances on the 401 wavelengths of a range. Figures: CIE 015 (illuminants), Ohta 1997
// (ColorChecker).
#pragma once
#include "optics/wavelength.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace nephroid::optics {

/// Rows (nm, value) by rising nm, linear between them, 0 outside the table. Where all rows are at whole nanometres, the
/// values there; else each wavelength has the mean about it, so that sums are integrals and a laser's line is not lost.
Spectrum spectrum_of_table(std::span<const std::array<double, 2>> sorted);
/// Rows as above, integrated over each cell of a range.
Spectrum integrals_of_table(std::span<const std::array<double, 2>> sorted, SpectralRange range);

/// The spectra of lights here sum to 1 over 380..780 nm; multiply by watts. In the solar range what the light has
/// beyond is added to that; of illuminants nothing is known there, and they have none. name: A, D50, D65, E, F1..F12.
/// Throws bad_input listing the known names and the nearest.
Spectrum illuminant(const std::string& name, SpectralRange range = SpectralRange::visible);
/// Planck's law. Throws bad_input where temperature_k is not above 0.
Spectrum blackbody(double temperature_k, SpectralRange range = SpectralRange::visible);
/// Rows (nm, relative power >= 0) in any order, as spectrum_of_table() takes them. Throws bad_input where nothing is
/// left in 380..780 nm, for a negative power, and for a wavelength given twice with different powers.
Spectrum light_table(std::span<const std::array<double, 2>> nm_power, SpectralRange range = SpectralRange::visible);
/// The power of each line goes to the two nearest wavelengths, linearly; lines outside the range give nothing.
Spectrum light_lines(std::span<const std::array<double, 2>> nm_power, SpectralRange range = SpectralRange::visible);
const std::vector<std::string>& illuminant_names();

/// Reflectances 0..1, not normalised. name: one of the 24 ColorChecker patches ("blue sky").
/// Throws bad_input listing the known names and the nearest.
Spectrum colorchecker_patch(const std::string& name, SpectralRange range = SpectralRange::visible);
const std::vector<std::string>& colorchecker_names();
/// Rows (nm, reflectance 0..1) in any order, linear between them, the end values held.
Spectrum reflectance_table(std::span<const std::array<double, 2>> nm_reflectance,
                           SpectralRange range = SpectralRange::visible);
Spectrum constant_spectrum(double value);

} // namespace nephroid::optics
