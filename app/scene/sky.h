// SPDX-License-Identifier: Apache-2.0
// The clear sky and the sun over a flat ground. The sky's luminance and colour: Preetham, Shirley, Smits, "A practical
// analytic model for daylight" (1999), fitted to turbidities of 2 to 6; beyond, its formulas go on. The sun's spectrum:
// the same paper's attenuation (after Iqbal 1983) of the extraterrestrial one (Thekaekara 1973), at the mean distance
// of the Earth. The model has no clouds and no twilight, and does not know the ground.
//
// y is up, north is -z, east is +x.
#pragma once
#include "scene/clear_sky.h"
#include "scene/environment.h"

#include <glm/glm.hpp>

namespace nephroid::scene {

/// The mean over a year; the sun's own is .524 to .542.
inline constexpr double sun_angular_diameter_deg = 0.533;

/// Texels of a sky's map.
inline constexpr int sky_width = 512, sky_height = 256;

/// Where the sun is. elevation_deg: above the horizon, as without air. azimuth_deg: 0 is north, 90 east; 0..360.
struct SunPlace {
  double elevation_deg = 0, azimuth_deg = 0;
};

/// By the low-precision formulas of the Astronomical Almanac: within .02 degrees. place: checked (preset::check).
SunPlace sun_place(const preset::PlaceAndTime& place);

/// To a place in the sky: unit.
glm::dvec3 to_sky(const SunPlace& place);

/// W m^-2 nm^-1 on a plane that faces the sun. elevation_deg: above 0. turbidity: 2..10.
optics::Spectrum sun_irradiance(double elevation_deg, double turbidity);

/// CIE xyY of the sky in a direction; Y in W m^-2 sr^-1, no factor 683. zenith: angle to it, 0..90 degrees; from_sun:
/// angle to the sun; sun_zenith: the sun's own.
optics::Colour sky_xyy(double zenith_deg, double from_sun_deg, double sun_zenith_deg, double turbidity);

/// The map of a sky without the sun's disc, before `rotate_deg`; colours beyond sRGB are in it. Texels below the
/// horizon are the ground, lit by sky and sun. Black at night. In the solar range its light is Bird and Riordan's
/// (clear_sky.h), of one colour, and spread over the sky as the luminance of the visible one is.
Environment make_sky(const preset::Environment& environment,
                     optics::SpectralRange range = optics::SpectralRange::visible);

/// What a clear sky, with its sun by day, gives before radiance and sun_scale.
ClearSky clear_sky_of(const preset::Environment& sky, optics::SpectralRange range);

/// Whether it is a sky whose sun is below the horizon.
bool is_night(const preset::Environment& environment);

} // namespace nephroid::scene
