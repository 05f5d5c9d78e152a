// SPDX-License-Identifier: Apache-2.0
// The nine dispersion formulas of the refractiveindex.info database ("Dispersion formulas" in its doc folder).
#pragma once
#include <span>

namespace nephroid::optics {

inline constexpr int formula_count = 9;

/// The most coefficients that formula 1..9 can use; 0: any number (formulas 1, 2, 3, 5 and 6 are sums of pairs).
int most_coefficients(int formula);

/// n by formula 1..9 at a wavelength in micrometres. Coefficients that are not there count as 0, and a term whose factor is 0
/// is left out before its denominator is looked at. NaN or infinite where the formula has no value (n^2 < 0, a pole).
double index_by_formula(int formula, std::span<const double> coefficients, double um);

} // namespace nephroid::optics
