// SPDX-License-Identifier: Apache-2.0
// The wavelengths of a run: 401 cells. Pictures are of the visible range, 380..780 nm in steps of 1 nm. Meters of
// scenes with light beyond it are of the solar range, 280..4000 nm.
#pragma once
#include <array>
#include <numeric>
#include <vector>

namespace nephroid::optics {

inline constexpr int first_nm = 380;
inline constexpr int last_nm = 780;
inline constexpr int wavelength_count = last_nm - first_nm + 1;

/// One value a cell of wavelengths; in the visible range index i is for first_nm + i.
using Spectrum = std::array<double, wavelength_count>;

inline constexpr int wavelength_nm(int index) { return first_nm + index; }

/// Which wavelengths the cells have. A quantity of light in a cell is in W, W m^-2, ..., all of the cell's together; a
/// quantity of matter is that at the cell's middle.
enum class SpectralRange { visible, solar };

/// Rising, without gaps: a cell begins where the one below ends.
struct Cells {
  Spectrum nm, width_nm;
};
/// Solar: 20 cells below the visible, 100 of 4 nm in it, 281 of .6 % of their wavelength beyond.
const Cells& cells(SpectralRange range);

/// The range's words for people: "380 to 780 nm".
const char* text_of(SpectralRange range);

/// The spectrum of value(nm) at the cells' middles.
template <class Value>
Spectrum spectrum_of(const Value& value, SpectralRange range = SpectralRange::visible) {
  Spectrum spectrum{};
  const Spectrum& nm = cells(range).nm;
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] = value(nm[i]);
  return spectrum;
}

/// All of a quantity of light.
inline double sum_of(const Spectrum& spectrum) { return std::accumulate(spectrum.begin(), spectrum.end(), 0.0); }

/// Light of the visible range, in the cells of another one: its sum stays.
Spectrum rebinned(const Spectrum& visible, SpectralRange range);

/// Fraunhofer's lines, at which indices of refraction are given; the Abbe number is (n_d - 1) / (n_F - n_C).
inline constexpr double line_f_nm = 486.1327, line_e_nm = 546.0740, line_d_nm = 587.5618, line_c_nm = 656.2725;

/// Every index in order: one cluster of all wavelengths, where a path has all of them, or any one.
inline std::vector<int> all_wavelengths() {
  std::vector<int> indices(wavelength_count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

} // namespace nephroid::optics
