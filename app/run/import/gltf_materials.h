// SPDX-License-Identifier: Apache-2.0
// Materials of glTF as ours, which know glass, mirrors and matt surfaces and nothing between.
#pragma once
#include "preset/preset.h"
#include "run/import/gltf_file.h"

#include <array>
#include <string>
#include <vector>

namespace nephroid::run {

/// KHR_materials_dispersion gives 20 / V with the Abbe number V = (n_d - 1) / (n_F - n_C). Cauchy's n = a + b / l^2 with that n_d and V.
preset::Dispersion dispersion_of(double ior, double dispersion);

/// Where glass absorbs: a dispersion file in the form of refractiveindex.info, with the n of `clear` (a result of dispersion_of) and the k
/// of KHR_materials_volume: after attenuationDistance the smoothest spectrum of attenuationColor is left, at least 1e-4 of the light. Empty
/// for clear glass and for what is thin in the file.
std::string absorbing_glass_file(const GltfValue& material, const preset::Dispersion& clear);

/// A reflectance of this linear sRGB colour; one number where it is grey.
preset::Reflectance reflectance_of(const std::array<double, 3>& rgb);

/// name: for notes, which say what has no counterpart.
preset::Material material_of(const GltfValue& value, const std::string& name, std::vector<std::string>& notes);

} // namespace nephroid::run
