// SPDX-License-Identifier: Apache-2.0
// The wavelength grid of the whole program: 401 wavelengths, 380..780 nm in steps of 1 nm.
#pragma once
#include <array>
#include <numeric>
#include <vector>

namespace nephroid::optics {

inline constexpr int first_nm = 380;
inline constexpr int last_nm = 780;
inline constexpr int wavelength_count = last_nm - first_nm + 1;

/// One value a wavelength, index i for first_nm + i.
using Spectrum = std::array<double, wavelength_count>;

inline constexpr int wavelength_nm(int index) { return first_nm + index; }

/// The spectrum of value(nm).
template <class Value>
Spectrum spectrum_of(const Value& value) {
  Spectrum spectrum{};
  for (int i = 0; i < wavelength_count; ++i) spectrum[static_cast<std::size_t>(i)] = value(wavelength_nm(i));
  return spectrum;
}

/// Fraunhofer's lines, at which indices of refraction are given; the Abbe number is (n_d - 1) / (n_F - n_C).
inline constexpr double line_f_nm = 486.1327, line_e_nm = 546.0740, line_d_nm = 587.5618, line_c_nm = 656.2725;

/// Every index in order: one cluster of all wavelengths, where a path has all of them, or any one.
inline std::vector<int> all_wavelengths() {
  std::vector<int> indices(wavelength_count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

} // namespace nephroid::optics
