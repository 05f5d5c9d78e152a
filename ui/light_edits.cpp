// SPDX-License-Identifier: Apache-2.0
#include "ui/light_edits.h"

#include "base/error.h"
#include "optics/wavelength.h"
#include "preset/describe_limits.h"
#include "scene/materials.h"
#include "ui/dispersion_edits.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

using preset::LightSpectrum;
using Type = LightSpectrum::Type;

constexpr double nearest_nm = 0.1; ///< that two rows come to each other
constexpr int table_step_nm = 20;

/// A preset is read by people: so many figures that nobody sees the rest.
double to_figures(double value, int figures)
{
  if (!(value > 0)) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - (figures - 1));
  // Of a unit below 1 the reciprocal is the exact number: 123 / 1000 and not 123 * 0.001, which is written with 17 figures.
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
}

double to_tenths(double nm) { return std::round(10 * nm) / 10; }

double legal_power(double power) { return to_figures(std::clamp(power, preset::power_bounds.low, preset::power_bounds.high), 4); }

/// The spectrum's power at whole wavelengths, 1 the largest; 1 everywhere where it has none.
double relative_power(const optics::Spectrum& values, int nm)
{
  const double largest = *std::max_element(values.begin(), values.end());
  return legal_power(values[static_cast<std::size_t>(nm - optics::first_nm)] / largest);
}

optics::Spectrum values_of(const LightSpectrum& spectrum)
{
  try {
    return scene::make_light_spectrum(spectrum, {});
  } catch (const Error&) {
    optics::Spectrum flat;
    flat.fill(1);
    return flat;
  }
}

std::vector<PowerRow> rows_at(const LightSpectrum& spectrum, int first_nm, int last_nm, int step_nm)
{
  const optics::Spectrum values = values_of(spectrum);
  std::vector<PowerRow> rows;
  for (int nm = first_nm; nm <= last_nm; nm += step_nm) rows.push_back({static_cast<double>(nm), relative_power(values, nm)});
  return rows;
}

} // namespace

bool has_rows(const LightSpectrum& spectrum) { return spectrum.type == Type::lines || spectrum.type == Type::table; }

double largest_power(const LightSpectrum& spectrum)
{
  double largest = 0;
  if (has_rows(spectrum))
    for (const PowerRow& row : spectrum.table) largest = std::max(largest, row[1]);
  return largest > 0 ? largest : 1;
}

LightSpectrum as_type(const LightSpectrum& spectrum, Type type)
{
  if (type == spectrum.type) return spectrum;
  LightSpectrum made;
  made.type = type;
  if (type == Type::illuminant || type == Type::blackbody) return made;
  if (has_rows(spectrum) && (type == Type::lines || spectrum.table.size() >= 2))
    made.table = spectrum.table;
  else if (type == Type::table)
    made.table = rows_at(spectrum, optics::first_nm, optics::last_nm, table_step_nm);
  else
    made.table = rows_at(spectrum, 450, 650, 100);
  return sorted(made);
}

LightSpectrum sorted(LightSpectrum spectrum)
{
  std::stable_sort(spectrum.table.begin(), spectrum.table.end(), [](const PowerRow& a, const PowerRow& b) { return a[0] < b[0]; });
  return spectrum;
}

void move_row(LightSpectrum& spectrum, std::size_t index, const PowerRow& to)
{
  if (!std::isfinite(to[0]) || !std::isfinite(to[1])) return;
  std::vector<PowerRow>& rows = spectrum.table;
  const double low = index == 0 ? preset::wavelength_bounds.low : to_tenths(rows[index - 1][0]) + nearest_nm;
  const double high = index + 1 == rows.size() ? preset::wavelength_bounds.high : to_tenths(rows[index + 1][0]) - nearest_nm;
  if (low <= high) rows[index][0] = to_tenths(std::clamp(to[0], low, high));
  rows[index][1] = legal_power(to[1]);
}

std::optional<std::size_t> add_row(LightSpectrum& spectrum, const PowerRow& row)
{
  std::vector<PowerRow>& rows = spectrum.table;
  const double nm = to_tenths(std::clamp(row[0], preset::wavelength_bounds.low, preset::wavelength_bounds.high));
  const auto near = [&](const PowerRow& other) { return std::abs(other[0] - nm) < 2 * nearest_nm; };
  if (rows.size() >= preset::max_rows || std::any_of(rows.begin(), rows.end(), near)) return std::nullopt;
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const PowerRow& other) { return other[0] > nm; });
  const auto added = rows.insert(at, {nm, legal_power(row[1])});
  return static_cast<std::size_t>(added - rows.begin());
}

std::optional<std::size_t> add_in_widest_gap(LightSpectrum& spectrum)
{
  const double nm = middle_of_widest_gap(spectrum.table);
  const std::vector<PowerRow>& rows = spectrum.table;
  if (spectrum.type == Type::lines) return add_row(spectrum, {nm, largest_power(spectrum) / 2});
  const auto right = std::find_if(rows.begin(), rows.end(), [&](const PowerRow& row) { return row[0] > nm; });
  if (right == rows.begin() || right == rows.end()) return add_row(spectrum, {nm, 0}); // a table has nothing outside
  const PowerRow a = *std::prev(right), b = *right;
  return add_row(spectrum, {nm, a[1] + (b[1] - a[1]) * (nm - a[0]) / (b[0] - a[0])});
}

bool can_remove_row(const LightSpectrum& spectrum) { return spectrum.table.size() > (spectrum.type == Type::table ? 2u : 1u); }

void remove_row(LightSpectrum& spectrum, std::size_t index)
{
  spectrum.table.erase(spectrum.table.begin() + static_cast<std::ptrdiff_t>(index));
}

} // namespace nephroid::ui
