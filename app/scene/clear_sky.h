// SPDX-License-Identifier: Apache-2.0
// How much light of each wavelength a clear sky and its sun give: Bird and Riordan, "Simple solar spectral model for
// direct and diffuse irradiance on horizontal and tilted planes at the Earth's surface for cloudless atmospheres"
// (1986). The data is theirs, from 300 to 4000 nm, and has the sun's lines and the air's bands in steps of 5 to 100 nm.
#pragma once
#include "optics/wavelength.h"

namespace nephroid::scene {

/// What is in the air above a place.
struct Air {
  double aerosol_depth = 0.27; ///< optical depth of the aerosol at 500 nm, straight up
  double angstrom = 1.3;       ///< the power of 1 / wavelength by which that goes
  double water_cm = 2;         ///< water vapour as water
  double ozone_cm = 0.35;      ///< as gas at 0 degrees C and 1013 hPa
  double pressure = 1;         ///< in 1013 hPa
};
/// That of Preetham's sun (sky.h) at the sea. turbidity: 2..10.
Air air_of(double turbidity);

/// W m^-2 in each cell of a range (optics::cells).
struct ClearSky {
  optics::Spectrum direct{};  ///< of the sun, on a plane that faces it
  optics::Spectrum diffuse{}; ///< of the sky, on a level plane
};
/// elevation_deg: the sun's, above 0. albedo: of the ground, 0..1, which the air sends back a part of. distance_factor:
/// the square of the mean distance of the Earth over that of the day.
ClearSky clear_sky(double elevation_deg, const Air& air, double albedo, double distance_factor,
                   optics::SpectralRange range);

/// The distance factor of a day of the year, 1..366 (Spencer 1971): .967 to 1.035.
double distance_factor(double day_of_year);

} // namespace nephroid::scene
