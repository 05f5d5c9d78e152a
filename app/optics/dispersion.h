// SPDX-License-Identifier: Apache-2.0
// Dispersion: n and k as functions of wavelength, from formulas, tables and control points.
#pragma once
#include "optics/wavelength.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace nephroid::optics {

/// What to answer outside the data's own range. automatic: extrapolate a formula, hold a table. hold: the value at the
/// nearest end. extrapolate: a formula goes on; a table has no law to go on by, so it holds. refuse: an error.
enum class Extrapolation { automatic, hold, extrapolate, refuse };

struct IndexSample {
  double nm = 0;
  std::optional<double> n;   ///< empty: the data has no n here (or a formula gives no finite number)
  std::optional<double> k;   ///< empty: the data has no k at all
  bool extrapolated = false; ///< nm lies outside the data's own range (beyond a relative tolerance of 1e-6 at its ends)
};

/// n(lambda) or k(lambda) on its own range. Its value is defined wherever a formula is; a table holds its ends.
struct Curve {
  std::function<double(double nm)> value;
  double low_nm = 0, high_nm = 0;
  bool formula = false;                          ///< may be extrapolated
  std::optional<std::array<double, 2>> gap_nm{}; ///< a table's hole within 380..780 nm, bridged by a line
};

struct DispersionCurve {
  std::string name;   ///< file stem or kind, for people
  std::string source; ///< the file or kind that errors point at
  std::optional<Curve> n, k;

  /// The range of n, or of k where there is no n.
  std::array<double, 2> range_nm() const;
  /// nm: finite and > 0. Throws bad_input with Extrapolation::refuse where nm is outside the range.
  IndexSample sample(double nm, Extrapolation outside = Extrapolation::automatic) const;
};

/// n on the 401 wavelengths of a range. In the solar range a formula that goes on beyond its range and gives no index
/// there is held at the end of the range. Throws bad_input where n is missing, not finite or <= 0, and, refusing, for a
/// gap.
Spectrum sample_n(const DispersionCurve& curve, Extrapolation outside, SpectralRange range = SpectralRange::visible);
/// k on them (0 where the data has none or a negative value; ends held unless refused).
Spectrum sample_k(const DispersionCurve& curve, Extrapolation outside, SpectralRange range = SpectralRange::visible);
/// What a run must say when its range, as 380..780 nm, reaches beyond the data of n, e.g. "N-SF66: n is extrapolated
/// below 390 nm (data: 390..2500 nm)", or into a gap of it; empty where they do not.
std::string outside_note(const DispersionCurve& curve, Extrapolation outside,
                         SpectralRange range = SpectralRange::visible);

/// V_d = (n_d - 1) / (n_F - n_C); empty if the data does not reach the three lines or has no dispersion.
std::optional<double> abbe_number(const DispersionCurve& curve);

/// The same n > 0 at every wavelength.
DispersionCurve constant_index(double n);
/// n^2 = 1 + sum b l^2 / (l^2 - c); l in micrometres, c in square micrometres. low/high: the fit's range.
DispersionCurve sellmeier(std::span<const double> b, std::span<const double> c_um2, double low_nm = 380,
                          double high_nm = 780);
/// n = c0 + c1 / l^2 + c2 / l^4 + ...; l in micrometres. At least one coefficient.
DispersionCurve cauchy(std::span<const double> coefficients, double low_nm = 380, double high_nm = 780);
/// Linear between (nm, n) rows. Rows are sorted; a wavelength given twice with different values is refused.
DispersionCurve tabulated(std::span<const std::array<double, 2>> nm_n);
/// Monotone cubic (Fritsch and Carlson 1980) through control points (nm, n), sorted and checked as above.
DispersionCurve control_points(std::span<const std::array<double, 2>> nm_n);

/// The dispersion formulas of the refractiveindex.info database ("Dispersion formulas" in its doc folder).
inline constexpr int formula_count = 9;

/// The most coefficients that formula 1..9 can use; 0: any number (formulas 1, 2, 3, 5 and 6 are sums of pairs).
int most_coefficients(int formula);

/// n by formula 1..9 at a wavelength in micrometres. Coefficients that are not there count as 0, and a term whose
/// factor is 0 is left out before its denominator is looked at. Not finite where n^2 < 0 and at a pole.
double index_by_formula(int formula, std::span<const double> coefficients, double um);

} // namespace nephroid::optics
