// SPDX-License-Identifier: Apache-2.0
#include "optics/spectrum.h"

#include "base/error.h"
#include "base/nearest.h"
#include "optics/tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace nephroid::optics {
namespace {

/// Divides by the sum over 380..780 nm. Throws bad_input where there is nothing to divide.
Spectrum normalised(Spectrum spectrum, const std::string& what, SpectralRange range = SpectralRange::visible) {
  double sum = 0;
  for (std::size_t i = 0; i < spectrum.size(); ++i)
    if (const double nm = cells(range).nm[i]; nm > first_nm - 0.5 && nm < last_nm + 0.5) sum += spectrum[i];
  if (!(sum > 0) || !std::isfinite(sum))
    throw bad_input({}, what + fmt::format(" has no power in {}..{} nm", first_nm, last_nm),
                    "expected at least one wavelength with power there");
  for (double& value : spectrum) value /= sum;
  return spectrum;
}

/// The end values are held outside the table.
Spectrum held(const LinearTable& table, SpectralRange range) { return spectrum_of(table, range); }

/// Of a table that is 0 outside, from low to high.
double integral(const LinearTable& table, double low, double high) {
  low = std::max(low, table.low()), high = std::min(high, table.high());
  if (!(low < high)) return 0;
  double sum = 0, from = low;
  const auto add = [&](double to) { sum += (to - from) * (table(from) + table(to)) / 2, from = to; };
  for (const Row& row : table.rows())
    if (row[0] > low && row[0] < high) add(row[0]);
  add(high);
  return sum;
}

/// The mean about a wavelength by weights that fall to 0 at its two neighbours, so that sums over all wavelengths are
/// integrals and keep their place. It is exact: between corners, table times weight is a parabola. An end of the table
/// that is not 0 is a cut: what is beyond is not known and does not count.
double mean_about(const LinearTable& table, double nm) {
  const bool is_cut_below = table(table.low()) != 0, is_cut_above = table(table.high()) != 0;
  if ((nm < table.low() && is_cut_below) || (nm > table.high() && is_cut_above)) return 0;
  std::vector<double> corners{nm - 1, nm, nm + 1};
  for (const Row& row : table.rows())
    if (std::abs(row[0] - nm) < 1) corners.push_back(row[0]);
  std::ranges::sort(corners);
  double sum = 0, weights = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double a = corners[i - 1], b = corners[i], middle = (a + b) / 2;
    const bool is_below = middle<table.low(), is_above = middle> table.high();
    if ((is_below && is_cut_below) || (is_above && is_cut_above)) continue;
    weights += (b - a) * (1 - std::abs(middle - nm));
    if (is_below || is_above) continue;
    const auto weighted = [&](double x) { return table(x) * (1 - std::abs(x - nm)); };
    sum += (b - a) / 6 * (weighted(a) + 4 * weighted(middle) + weighted(b));
  }
  return weights > 0 ? sum / weights : 0;
}

void require_no_negative_power(std::span<const Row> rows) {
  for (const Row& row : rows)
    if (row[1] < 0)
      throw bad_input({}, fmt::format("the light's power at {} nm is {}", row[0], row[1]), "expected 0 or more");
}

/// A column by its name. Throws bad_input that lists the known names.
LinearTable column(const Table& table, const char* kind, const std::string& name) {
  const auto place = std::ranges::find(table.columns, name);
  if (place != table.columns.end())
    return LinearTable(table.rows(static_cast<std::size_t>(place - table.columns.begin())));
  const std::string near = nearest(name, table.columns);
  throw bad_input({}, fmt::format("no {} is called \"{}\"", kind, name),
                  fmt::format("expected one of {}", fmt::join(table.columns, ", ")),
                  near.empty() ? std::string{} : fmt::format("did you mean \"{}\"?", near));
}

const Table& illuminants() {
  static const Table table = read_table("illuminants");
  return table;
}

const Table& colorchecker() {
  static const Table table = read_table("colorchecker-24-ohta");
  return table;
}

} // namespace

const std::vector<std::string>& illuminant_names() { return illuminants().columns; }

Spectrum illuminant(const std::string& name, SpectralRange range) {
  const LinearTable table = column(illuminants(), "illuminant", name);
  return rebinned(normalised(spectrum_of_table(table.rows()), "illuminant " + name), range);
}

Spectrum blackbody(double temperature_k, SpectralRange range) {
  if (!std::isfinite(temperature_k) || !(temperature_k > 0))
    throw bad_input({}, fmt::format("a black body of {} K", temperature_k), "expected a temperature above 0 K");
  // Planck: lambda^-5 / (exp(c2 / (lambda T)) - 1), with c2 = h c / k_B (SI 2019, exact figures). Divided by its value
  // at the red end, exponents stay small: a body of 1 K has no blue light, and not 0 / 0 of it.
  constexpr double c2_nm_k = 1.438776877503933e7;
  const double reference = c2_nm_k / (last_nm * temperature_k);
  Spectrum spectrum = spectrum_of(
      [&](double nm) {
        const double exponent = c2_nm_k / (nm * temperature_k);
        return std::pow(last_nm / nm, 5) * std::exp(reference - exponent) * std::expm1(-reference) /
               std::expm1(-exponent);
      },
      range);
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= cells(range).width_nm[i];
  return normalised(spectrum, fmt::format("a black body of {} K", temperature_k), range);
}

Spectrum spectrum_of_table(std::span<const Row> sorted) {
  const LinearTable table({sorted.begin(), sorted.end()});
  if (std::ranges::any_of(sorted, [](const Row& row) { return row[0] != std::round(row[0]); }))
    return spectrum_of([&](double nm) { return mean_about(table, nm); });
  return spectrum_of([&](double nm) { return nm >= table.low() && nm <= table.high() ? table(nm) : 0; });
}

Spectrum integrals_of_table(std::span<const Row> sorted, SpectralRange range) {
  const LinearTable table({sorted.begin(), sorted.end()});
  Spectrum spectrum{};
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double nm = cells(range).nm[i], half = cells(range).width_nm[i] / 2;
    spectrum[i] = integral(table, nm - half, nm + half);
  }
  return spectrum;
}

Spectrum light_table(std::span<const std::array<double, 2>> nm_power, SpectralRange range) {
  require_no_negative_power(nm_power);
  const std::vector<Row> rows = sorted_rows(nm_power, Duplicates::refuse, {});
  const Spectrum visible = normalised(spectrum_of_table(rows), "the light's table");
  if (range == SpectralRange::visible || !(rows.front()[0] < first_nm || rows.back()[0] > last_nm))
    return rebinned(visible, range);
  return normalised(integrals_of_table(rows, range), "the light's table", range);
}

Spectrum light_lines(std::span<const std::array<double, 2>> nm_power, SpectralRange range) {
  require_no_negative_power(nm_power);
  Spectrum spectrum{};
  for (const auto& [nm, power] : nm_power) {
    if (!std::isfinite(nm) || !std::isfinite(power)) throw bad_input({}, "a line holds a number that is not finite");
    const Spectrum& middles = cells(range).nm;
    if (nm < middles.front() || nm > middles.back()) continue;
    const auto above = std::ranges::upper_bound(middles, nm);
    const auto below = static_cast<std::size_t>(above - middles.begin()) - 1;
    const double share = above == middles.end() ? 0 : (nm - middles[below]) / (*above - middles[below]);
    spectrum[below] += power * (1 - share);
    if (share > 0) spectrum[below + 1] += power * share;
  }
  return normalised(spectrum, "the light's list of lines", range);
}

const std::vector<std::string>& colorchecker_names() { return colorchecker().columns; }

Spectrum colorchecker_patch(const std::string& name, SpectralRange range) {
  return held(column(colorchecker(), "ColorChecker patch", name), range);
}

Spectrum reflectance_table(std::span<const std::array<double, 2>> nm_reflectance, SpectralRange range) {
  for (const auto& [nm, value] : nm_reflectance)
    if (!(value >= 0 && value <= 1))
      throw bad_input({}, fmt::format("the reflectance at {} nm is {}", nm, value), "expected 0 to 1");
  return held(LinearTable(sorted_rows(nm_reflectance, Duplicates::refuse, {})), range);
}

Spectrum constant_spectrum(double value) {
  Spectrum spectrum{};
  spectrum.fill(value);
  return spectrum;
}

} // namespace nephroid::optics
