// SPDX-License-Identifier: Apache-2.0
// Lights of KHR_lights_punctual as ours. glTF says what an eye sees (candela, lux), we say watts: both units meet here and nowhere else.
#pragma once
#include "optics/wavelength.h"
#include "preset/preset.h"
#include "run/import/gltf_nodes.h"

#include <array>
#include <string>
#include <vector>

namespace nephroid::run {

/// Lumens a watt of 380..780 nm: 683 times the mean of the eye's luminosity, weighted by the spectrum.
double lumens_per_watt(const optics::Spectrum& spectrum);

/// A light's spectrum and how its figures become watts.
struct LightColour {
  preset::LightSpectrum spectrum;
  double watts_per_lumen = 0; ///< times the luminance of the colour, which the file's intensity is multiplied by
};
/// Linear sRGB. White is D65, as in sRGB; a colour has the smoothest spectrum that shows it.
LightColour light_colour(const std::array<double, 3>& rgb);

/// The light of a node, which shines along its -z axis. light: an item of the extension's list. Intensities in candela, of "directional" in
/// lux.
preset::Light light_of(const GltfValue& value, const glm::dmat4& to_world, const std::string& name, std::vector<std::string>& notes);

/// What the light gives a surface that faces it at this point, in luminous watts a square metre: lux / 683.
double luminous_irradiance(const preset::Light& light, const glm::dvec3& at);

} // namespace nephroid::run
