// SPDX-License-Identifier: Apache-2.0
// A scene as glTF 2.0: what formats/import/gltf_scene.h reads, the other way round.
#pragma once
#include "formats/export/export.h"
#include "formats/export/glb.h"

namespace nephroid::formats {

/// Linear sRGB, 0..1, under D65.
std::array<double, 3> colour_of_reflectance(const optics::Spectrum& reflectance);

/// The colour of a light's spectrum.
struct GltfColour {
  std::array<double, 3> rgb{};  ///< linear sRGB, the largest is 1
  double luminous_per_watt = 0; ///< over the luminance of rgb
};
GltfColour colour_of_light(const optics::Spectrum& spectrum);

/// Preset coordinates in metres, y up. Area lights and the surroundings have no counterpart; the caustics are light
/// that the receivers' materials send out, in cd/m^2.
Glb gltf_of(const scene::Scene& scene, const preset::Preset& preset, const std::vector<Caustic>& caustics);

} // namespace nephroid::formats
