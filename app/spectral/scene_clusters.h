// SPDX-License-Identifier: Apache-2.0
// The wavelength clusters of a whole scene.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::spectral {

/// The clusters (indices of wavelengths) for all dielectrics that an object uses: of one curve its own, of several their common
/// refinement, of none one group. Every wavelength is in exactly one. Throws bad_input as cluster_wavelengths does.
std::vector<std::vector<int>> scene_clusters(const preset::Spectral& settings, const scene::Scene& scene);

} // namespace nephroid::spectral
