// SPDX-License-Identifier: Apache-2.0
#include "scene/clear_sky.h"

#include "optics/spectrum.h"
#include "optics/tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid::scene {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The air masses along a way: relative, relative times pressure, and through the ozone, which is 22 km up.
struct Masses {
  double air = 0, pressed = 0, ozone = 0;
};

Masses masses_of(double elevation_deg, double pressure) {
  const double sine = std::sin(elevation_deg * degree), zenith_deg = 90 - elevation_deg;
  const double air = 1 / (sine + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
  constexpr double height = 22.0 / 6370;
  return {air, air * pressure, (1 + height) / std::sqrt(sine * sine + 2 * height)};
}

/// What the aerosol does with a wavelength.
struct Aerosol {
  double depth = 0, scattered = 0; ///< optical depth; the part of what it takes that is scattered
};

/// The part of a wavelength that is left, by cause.
struct Left {
  double rayleigh = 0, scattering = 0, absorption = 0, gases = 0; ///< scattering, absorption: by aerosol
};

/// a: water, ozone, mixed gases of the table.
Left left_of(const Masses& mass, double um, const Aerosol& aerosol, const Air& air, const std::array<double, 3>& a) {
  const double square = um * um, water = a[0] * air.water_cm * mass.air, mixed = a[2] * mass.pressed;
  return {std::exp(-mass.pressed / (square * square * (115.6406 - 1.335 / square))),
          std::exp(-aerosol.scattered * aerosol.depth * mass.air),
          std::exp(-(1 - aerosol.scattered) * aerosol.depth * mass.air),
          std::exp(-0.2385 * water / std::pow(1 + 20.07 * water, 0.45) - a[1] * air.ozone_cm * mass.ozone -
                   1.41 * mixed / std::pow(1 + 118.3 * mixed, 0.45))};
}

/// The part of the light that aerosol scatters which goes down. sine: of the sun's elevation.
double downwards(double sine) {
  constexpr double mean_cosine = 0.65;
  const double g = std::log(1 - mean_cosine);
  const double a = g * (1.459 + g * (0.1595 + g * 0.4129)), b = g * (0.0783 + g * (-0.3824 - g * 0.5874));
  return 1 - 0.5 * std::exp((a + b * sine) * sine);
}

} // namespace

Air air_of(double turbidity) {
  Air air;
  const double at_1_um = 0.04608365822050 * turbidity - 0.04586025928522; // Angstrom's beta by Preetham et al.
  air.aerosol_depth = at_1_um * std::pow(0.5, -air.angstrom);
  return air;
}

ClearSky clear_sky(double elevation_deg, const Air& air, double albedo, double distance_factor,
                   optics::SpectralRange range) {
  static const optics::Table table = optics::read_table("bird-riordan");
  const double sine = std::sin(elevation_deg * degree);
  const Masses mass = masses_of(elevation_deg, air.pressure);
  const Masses back{1.8, 1.8 * air.pressure, 1.8}; // for light that comes from all sides
  std::vector<optics::Row> direct, diffuse;
  for (std::size_t i = 0; i < table.nm.size(); ++i) {
    const double um = table.nm[i] / 1000;
    const std::array<double, 3> a{table.values[1][i], table.values[2][i], table.values[3][i]};
    const double of_04 = std::log(um / 0.4);
    const Aerosol aerosol{air.aerosol_depth * std::pow(um / 0.5, -air.angstrom),
                          0.945 * std::exp(-0.095 * of_04 * of_04)};
    const Left left = left_of(mass, um, aerosol, air, a), there = left_of(back, um, aerosol, air, a);
    const double sun = table.values[0][i] * distance_factor,
                 beam = sun * left.rayleigh * left.scattering * left.absorption * left.gases;
    const double lit = sun * sine * left.gases * left.absorption;
    const double rayleigh = lit * (1 - std::pow(left.rayleigh, 0.95)) / 2,
                 haze = lit * std::pow(left.rayleigh, 1.5) * (1 - left.scattering) * downwards(sine);
    const double sent_back =
        there.gases * there.absorption *
        ((1 - there.rayleigh) / 2 + (1 - downwards(1 / 1.8)) * there.rayleigh * (1 - there.scattering));
    const double again = (beam * sine + rayleigh + haze) * sent_back * albedo / (1 - sent_back * albedo);
    const double ultraviolet = um <= 0.45 ? std::pow(um + 0.55, 1.8) : 1;
    direct.push_back({table.nm[i], beam});
    diffuse.push_back({table.nm[i], (rayleigh + haze + again) * ultraviolet});
  }
  return {optics::integrals_of_table(direct, range), optics::integrals_of_table(diffuse, range)};
}

double distance_factor(double day_of_year) {
  const double angle = 2 * std::numbers::pi * (day_of_year - 1) / 365;
  return 1.000110 + 0.034221 * std::cos(angle) + 0.001280 * std::sin(angle) + 0.000719 * std::cos(2 * angle) +
         0.000077 * std::sin(2 * angle);
}

} // namespace nephroid::scene
