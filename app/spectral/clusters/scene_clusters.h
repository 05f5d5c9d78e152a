// SPDX-License-Identifier: Apache-2.0
// The wavelength clusters of a whole scene.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::spectral {

/// The clusters (indices of wavelengths) for all dielectrics that an object uses: of one curve its own, of several their common
/// refinement, of none one group; by brute_force groups of Spectral::step_nm neighbours whatever the glass. Every wavelength is in exactly
/// one. Where splats are stretched along the wavelength, a cluster is a run of neighbours. Throws bad_input as cluster_wavelengths does.
std::vector<std::vector<int>> scene_clusters(const preset::Spectral& settings, const scene::Scene& scene);

} // namespace nephroid::spectral
