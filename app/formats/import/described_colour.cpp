// SPDX-License-Identifier: Apache-2.0
#include "formats/import/described_colour.h"

#include "base/error.h"
#include "base/files.h"
#include "formats/import/description.h"
#include "optics/coat.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "scatter/spectra.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace nephroid::formats {
namespace {

using Rows = std::vector<std::array<double, 2>>;

DescribedColour spectral(const optics::Spectrum& spectrum, double unit) {
  DescribedColour colour;
  colour.spectrum = spectrum;
  colour.luminance = optics::to_xyz(spectrum)[1] / unit;
  return colour;
}

/// The spectrum without the rows that lie on the line between their neighbours.
Rows rows_of(const optics::Spectrum& spectrum) {
  const double largest = *std::ranges::max_element(spectrum);
  Rows rows;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == spectrum.size();
    if (is_end || std::abs(2 * spectrum[i] - spectrum[i - 1] - spectrum[i + 1]) > 1e-9 * largest)
      rows.push_back({static_cast<double>(optics::wavelength_nm(static_cast<int>(i))), spectrum[i]});
  }
  return rows;
}

} // namespace

bool DescribedColour::is_black() const { return spectrum ? !(luminance > 0) : !(std::max({rgb.x, rgb.y, rgb.z}) > 0); }

DescribedColour operator*(DescribedColour colour, double factor) {
  colour.rgb *= factor;
  colour.luminance *= factor;
  if (colour.spectrum)
    for (double& value : *colour.spectrum) value *= factor;
  return colour;
}

DescribedColour spectrum_of_rows(Rows rows, double unit, const Location& where) {
  if (rows.empty()) throw bad_input(where, "the spectrum has no values");
  std::ranges::sort(rows, {}, [](const auto& row) { return row[0]; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][1] < 0) throw bad_input(where, fmt::format("the spectrum is negative at {} nm", rows[i][0]));
    if (i > 0 && rows[i][0] == rows[i - 1][0])
      throw bad_input(where, fmt::format("the spectrum has {} nm twice", rows[i][0]));
  }
  return spectral(optics::spectrum_of_table(rows), unit);
}

Rows rows_of_file(const std::filesystem::path& file, const Location& where) {
  if (!is_there(file)) throw bad_input(where, "the spectrum " + file.string() + " is not there", {}, "put it there");
  std::istringstream lines(read_file(file));
  Rows rows;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::string nm, value, more;
    if (!(words >> nm)) continue;
    const auto x = scene_number(nm), y = words >> value ? scene_number(value) : std::nullopt;
    if (!x || !y || words >> more)
      throw bad_input(Location(file.string(), number), "is no row of a spectrum", "expected a wavelength and a value");
    rows.push_back({*x, *y});
  }
  return rows;
}

DescribedColour blackbody_of(double temperature_k, double unit, const Location& where) {
  if (!(temperature_k >= 100 && temperature_k <= 1e6))
    throw bad_input(where, fmt::format("a blackbody of {} K gives no light to see by", temperature_k),
                    "expected 100 to 1000000");
  // CODATA 2018; 2 h c^2 in W m^2, h c / k in m K.
  constexpr double c1 = 1.191042972e-16, c2 = 1.438776877e-2;
  DescribedColour colour = spectral(optics::spectrum_of([&](double nm) {
                                      const double m = nm * 1e-9;
                                      return 1e-9 * c1 / (std::pow(m, 5) * std::expm1(c2 / (m * temperature_k)));
                                    }),
                                    unit);
  colour.light.emplace().type = preset::LightSpectrum::Type::blackbody;
  colour.light->temperature_k = temperature_k;
  return colour;
}

DescribedColour illuminant_of(const std::string& name, double unit) {
  DescribedColour colour = spectral(optics::illuminant(name), unit);
  colour.light.emplace().illuminant = name;
  return colour;
}

DescribedColour even_spectrum(double value, double unit) {
  DescribedColour colour = spectral(optics::constant_spectrum(value), unit);
  colour.light.emplace().illuminant = "E";
  return colour;
}

LightColour light_colour(const DescribedColour& colour) {
  if (!colour.spectrum) return light_colour(scene::to_vec3(colour.rgb));
  LightColour light;
  if (colour.is_black()) return light;
  if (colour.light)
    light.spectrum = *colour.light;
  else {
    const double largest = *std::ranges::max_element(*colour.spectrum);
    light.spectrum.type = preset::LightSpectrum::Type::table;
    light.spectrum.table = rows_of(*colour.spectrum);
    for (auto& row : light.spectrum.table) row[1] /= largest; // relative power: watts are the light's own
  }
  light.watts_per_lumen = colour.luminance / lumens_per_watt(scatter::make_light_spectrum(light.spectrum, "spectrum"));
  return light;
}

preset::Reflectance reflectance_of(const DescribedColour& colour) {
  if (!colour.spectrum) return reflectance_of(scene::to_vec3(colour.rgb));
  optics::Spectrum values = *colour.spectrum;
  for (double& value : values) value = std::min(value, 1.0);
  preset::Reflectance reflectance;
  reflectance.table = rows_of(values);
  reflectance.value = values[0];
  if (std::ranges::all_of(values, [&](double value) { return value == values[0]; }))
    reflectance.table.clear();
  else
    reflectance.type = preset::Reflectance::Type::table;
  return reflectance;
}

void make_plastic(preset::Material& matt, double n, double roughness, bool below) {
  matt.type = preset::Material::Type::plastic;
  matt.dispersion.n = std::clamp(n, 1.0, 4.0);
  matt.roughness = roughness;
  if (!below) return;
  const optics::Coat coat = optics::make_coat(matt.dispersion.n, roughness * roughness);
  const auto darken = [&](double& part) { part = optics::seen_below_coat(coat, matt.dispersion.n, part); };
  darken(matt.reflectance.value);
  for (auto& row : matt.reflectance.table) darken(row[1]);
}

preset::Material mixed(const preset::Material& one, const preset::Material& other, double weight, const Location& where,
                       Description& into) {
  preset::Material made = one;
  made.reflectance = other.reflectance;
  if (!(made == other)) {
    into.note(where, "materials that are not of one kind are not blended: the heavier one is taken");
    return weight > 0.5 ? other : one;
  }
  DescribedColour mean;
  mean.spectrum = scatter::make_reflectance(one.reflectance, where);
  const optics::Spectrum second = scatter::make_reflectance(other.reflectance, where);
  for (std::size_t i = 0; i < second.size(); ++i)
    (*mean.spectrum)[i] = std::lerp((*mean.spectrum)[i], second[i], std::clamp(weight, 0.0, 1.0));
  made.reflectance = reflectance_of(mean);
  return made;
}

optics::Spectrum values_of(const DescribedColour& colour) {
  if (colour.spectrum) return *colour.spectrum;
  const double largest = std::max({colour.rgb.x, colour.rgb.y, colour.rgb.z});
  if (!(largest > 0)) return {};
  const preset::Reflectance share = reflectance_of(scene::to_vec3(colour.rgb / largest));
  optics::Spectrum values = scatter::make_reflectance(share, "colour");
  for (double& value : values) value *= largest;
  return values;
}

glm::dvec3 linear_srgb_of(const DescribedColour& colour) {
  if (!colour.spectrum) return colour.rgb;
  const auto rgb = optics::xyz_to_linear_srgb(optics::to_xyz(*colour.spectrum));
  const double luminance = optics::to_xyz(*colour.spectrum)[1];
  if (!(luminance > 0)) return glm::dvec3(0);
  return glm::max(glm::dvec3(rgb[0], rgb[1], rgb[2]), 0.0) * (colour.luminance / luminance);
}

} // namespace nephroid::formats
