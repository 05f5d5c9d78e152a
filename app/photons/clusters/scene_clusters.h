// SPDX-License-Identifier: Apache-2.0
// The wavelength clusters of a scene, for all its glass together.
#pragma once
#include "photons/settings.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::photons {

/// Layers keep one number for the light that losses leave of a whole cluster (kernels/photons/layers.h). This is its
/// largest error for a light with a single wavelength of the cluster; for smooth light it is far smaller.
constexpr double largest_loss_difference = 0.1;

/// The clusters (indices of wavelengths) for all dielectrics that an object uses. One curve has its own clusters,
/// several have their common refinement, none has one group. With brute_force they are groups of Settings::step_nm
/// neighbours whatever the glass. Every wavelength is in exactly one. Where splats are stretched along the wavelength,
/// a cluster is a run of neighbours. Where layers are kept for another light, glass and mirrors absorb about as much of
/// each wavelength of a cluster (split_by_losses). Throws bad_input as cluster_wavelengths does.
std::vector<std::vector<int>> scene_clusters(const Settings& settings, const scene::Scene& scene);

/// The largest difference of exp(-a s) and exp(-b s) for s in 0..longest; a, b >= 0.
double largest_difference(double a, double b, double longest);

/// Splits clusters so that the fractions which one material leaves of two wavelengths of a cluster differ by at most
/// `most`: in glass over any length up to twice the diagonal of the box about all objects of it, at a surface that it
/// meets up to `reflections` times. Each loss splits a cluster into the fewest parts; the result is their common
/// refinement, in no particular order. Where nothing absorbs, the clusters are returned as they are.
std::vector<std::vector<int>> split_by_losses(std::vector<std::vector<int>> clusters, const scene::Scene& scene,
                                              int reflections, double most);

} // namespace nephroid::photons
