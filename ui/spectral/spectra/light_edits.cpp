// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/spectra/curves.h"

#include "base/error.h"
#include "preset/field.h"
#include "scatter/spectra.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using preset::LightSpectrum;
using Type = LightSpectrum::Type;

constexpr int table_step_nm = 20;

double legal_power(double power) {
  return power > 0 ? with_digits(std::clamp(power, preset::power_bounds.low, preset::power_bounds.high), 4) : 0;
}

/// The spectrum's power at whole wavelengths, 1 the largest; 1 everywhere where it has none.
double relative_power(const optics::Spectrum& values, int nm) {
  const double largest = *std::max_element(values.begin(), values.end());
  return legal_power(values[static_cast<std::size_t>(nm - optics::first_nm)] / largest);
}

optics::Spectrum values_of(const LightSpectrum& spectrum) {
  try {
    return scatter::make_light_spectrum(spectrum, {});
  } catch (const Error&) {
    optics::Spectrum flat;
    flat.fill(1);
    return flat;
  }
}

} // namespace

bool has_rows(const LightSpectrum& spectrum) { return spectrum.type == Type::lines || spectrum.type == Type::table; }

double largest_power(const LightSpectrum& spectrum) {
  double largest = 0;
  if (has_rows(spectrum))
    for (const PowerRow& row : spectrum.table) largest = std::max(largest, row[1]);
  return largest > 0 ? largest : 1;
}

LightSpectrum as_table(const LightSpectrum& spectrum) {
  LightSpectrum sampled;
  sampled.type = Type::table;
  const optics::Spectrum values = values_of(spectrum);
  for (int nm = optics::first_nm; nm <= optics::last_nm; nm += table_step_nm)
    sampled.table.push_back({static_cast<double>(nm), relative_power(values, nm)});
  return sampled;
}

LightSpectrum sorted(LightSpectrum spectrum) {
  spectrum.table = sorted_rows(std::move(spectrum.table));
  return spectrum;
}

RowRules row_rules(const LightSpectrum& spectrum) {
  return {spectrum.type == Type::lines ? "line" : "row", preset::power_bounds, 0.1,
          spectrum.type == Type::table ? 2u : 1u, readable};
}

PowerRow readable(const PowerRow& row) {
  if (!std::isfinite(row[0]) || !std::isfinite(row[1])) return row;
  return {std::round(10 * row[0]) / 10, legal_power(row[1])};
}

PowerRow in_widest_gap(const LightSpectrum& spectrum) {
  const double nm = middle_of_widest_gap(spectrum.table);
  const std::vector<PowerRow>& rows = spectrum.table;
  if (spectrum.type == Type::lines) return readable({nm, largest_power(spectrum) / 2});
  const auto right = std::find_if(rows.begin(), rows.end(), [&](const PowerRow& row) { return row[0] > nm; });
  if (right == rows.begin() || right == rows.end()) return readable({nm, 0}); // a table has nothing outside
  const PowerRow a = *std::prev(right), b = *right;
  return readable({nm, a[1] + (b[1] - a[1]) * (nm - a[0]) / (b[0] - a[0])});
}

} // namespace nephroid::ui
