// SPDX-License-Identifier: Apache-2.0
// What is behind everything, infinitely far away, as a latitude-longitude picture; and that as a light: parallel light
// from every texel, in proportion to the texel's flux.
//
// A texel has one colour all over it, and the colour stands for the same spectrum as where it is seen: r, g and b times
// the spectra of the three sRGB primaries (optics/colour.h), times Environment::radiance. So a white diffuse
// surface has the colour that the map gives it by its irradiance, and what is seen through glass and what falls through
// glass are one light.
#pragma once
#include "base/files.h"
#include "optics/colour.h"
#include "preset/preset.h"

#include <array>
#include <cstddef>

namespace nephroid::scene {

/// The texel of row r (0: at +y) and column c is seen in the directions of elevation 90 - 180 (r + .5) / height degrees
/// and azimuth 360 (c + .5) / width - 180 degrees, counted from -z to the right (+x), after `rotate_deg` turned all of
/// it about +y to the left. One texel: the same everywhere.
struct Environment {
  int width = 0, height = 0;
  std::vector<float> rgb; ///< linear sRGB, finite, not negative, 3 a texel
  double radiance = 1;    ///< Y in W m^-2 sr^-1 of the colour (1, 1, 1)
  double rotate_deg = 0;
  bool lights = false;    ///< whether it is a light too; never where it is black
  std::string about = {}; ///< of a sky: where its sun is and the irradiances, for a plan
  std::array<optics::Spectrum, 3> primaries = optics::primary_spectra(); ///< of the colours red, green and blue

  /// Whether nothing of it can be seen.
  bool is_black() const;
};

/// A file is read as image/image.h says, multiplied by its alpha; a grey picture is as good as one with colours. Of
/// colours that sRGB does not have the luminance is kept.
/// Throws bad_input at the file for what is no such picture, naming the texel of a value that is NaN, infinite or
/// negative, and at `where` (FILE#/scene/environment) for a file that is not there. Values below 0 that are at most a
/// thousandth of all light in sum become 0. Appends to warnings where there are such, where the picture's shape is
/// not 2 : 1, and what the file says and is not obeyed.
Environment make_environment(const preset::Environment& environment, const FileFinder& finder, const Location& where,
                             std::vector<std::string>& warnings,
                             optics::SpectralRange range = optics::SpectralRange::visible);

/// What photons are drawn by: (r + g + b) / 3 of a texel, before Environment::radiance.
double grey(const Environment& environment, std::size_t texel);

/// Steradians that each texel of a row fills.
double texel_steradians(const Environment& environment, int row);

/// The flux of an environment that is not black.
struct EnvironmentFlux {
  double grey = 0;       ///< integral of grey() over all directions
  optics::Colour mean{}; ///< linear sRGB over grey(), a mean over the flux: the three sum to 3
  /// The root of the mean square over the flux of what a photon carries at each wavelength, summing to 1. A photon of a
  /// texel carries its colour's spectrum over grey(). That may be negative, where a spectrum of a primary is; this
  /// never is. Of one colour it is its spectrum.
  optics::Spectrum spectrum{};
  double power = 0; ///< by what that was divided, in W m^-2 for grey light of 1 sr and Environment::radiance 1
};
EnvironmentFlux flux_of(const Environment& environment);

} // namespace nephroid::scene
