// SPDX-License-Identifier: Apache-2.0
// What a metal reflects at all angles and wavelengths, as a few products of a function of each.
#pragma once
#include "optics/wavelength.h"

#include <array>

namespace nephroid::optics {

inline constexpr std::size_t conductor_term_count = 3;

/// -ln R(angle, wavelength) is nearly the sum over terms j of coefficients[j][wavelength] times -ln R_j(angle), with
/// R_j the exact reflectance at wavelengths[j]. So a path that stands for many wavelengths carries three numbers a
/// metal (kernels/scatter/conductor.h).
struct ConductorTerms {
  std::array<std::size_t, conductor_term_count> wavelengths{}; ///< indices 0..400
  std::array<Spectrum, conductor_term_count> coefficients{};
  double error = 0; ///< the largest of R over angles and wavelengths, from air. Of shipped metals below 0.001.
};

/// n, k: a metal's. The wavelengths are chosen one by one, each where the terms so far have the largest error of R, and
/// the coefficients by least squares. A metal that is alike at all wavelengths needs the first term only.
ConductorTerms conductor_terms(const Spectrum& n, const Spectrum& k);

} // namespace nephroid::optics
