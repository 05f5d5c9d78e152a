// SPDX-License-Identifier: Apache-2.0
// The environment as a light: parallel light from every texel, in proportion to the texel's flux.
//
// A texel has one colour all over it, and the colour stands for the same spectrum as where it is seen: r, g and b times the fixed spectra
// of the three sRGB primaries (optics/primary_spectra.h), times Environment::radiance. So a white diffuse surface has the colour that the
// map gives it by its irradiance, and what is seen through glass and what falls through glass are one light.
#pragma once
#include "optics/colour.h"
#include "optics/wavelength.h"
#include "scene/environment.h"
#include "scene/scene.h"

#include <cstddef>

namespace nephroid::scene {

/// What photons are drawn by: (r + g + b) / 3 of a texel, before Environment::radiance.
double grey(const Environment& environment, std::size_t texel);

/// Steradians that each texel of a row fills.
double texel_steradians(const Environment& environment, int row);

/// Of an environment that is not black.
struct EnvironmentFlux {
  double grey = 0;       ///< integral of grey() over all directions
  optics::Colour mean{}; ///< linear sRGB over grey(), a mean over the flux: the three sum to 3
  /// The root of the mean square over the flux of what a photon carries at each wavelength, summing to 1. A photon of a texel carries its
  /// colour's spectrum over grey(). That may be negative, where a spectrum of a primary is; this never is. Of one colour it is its
  /// spectrum.
  optics::Spectrum spectrum{};
  double power = 0; ///< by what that was divided, in W m^-2 for grey light of 1 sr and Environment::radiance 1
};
EnvironmentFlux flux_of(const Environment& environment);

/// Directional light of all directions together: its irradiance is that on a sphere, over the area of the sphere's shadow.
Light make_environment_light(const Environment& environment);

} // namespace nephroid::scene
