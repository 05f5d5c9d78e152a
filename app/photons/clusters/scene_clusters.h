// SPDX-License-Identifier: Apache-2.0
// The wavelength clusters of a scene, of all its glass together. No OpenCL here.
#pragma once
#include "photons/settings.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::photons {

/// Layers keep one number for what is left of a whole cluster (kernels/photons/layers.h): this is the most by which
/// that may be wrong for a light that has only one wavelength of it. Light that changes little inside of a cluster is
/// far less off.
constexpr double largest_loss_difference = 0.1;

/// The clusters (indices of wavelengths) for all dielectrics that an object uses: of one curve its own, of several
/// their common refinement, of none one group; by brute_force groups of Spectral::step_nm neighbours whatever the
/// glass. Every wavelength is in exactly one. Where splats are stretched along the wavelength, a cluster is a run of
/// neighbours. Where layers are kept for another light, glass and mirrors take about as much of each wavelength of a
/// cluster (split_by_losses). Throws bad_input as cluster_wavelengths does.
std::vector<std::vector<int>> scene_clusters(const Settings& settings, const scene::Scene& scene);

/// The most by which exp(-a s) and exp(-b s) differ for s in 0..longest; a, b >= 0.
double largest_difference(double a, double b, double longest);

/// Splits clusters so that, in each, what one material leaves of two wavelengths differs by at most `most`, whatever
/// the length: of glass up to twice the diagonal of the box about all objects of it, on a mirror up to `reflections`
/// times. In each cluster the fewest parts for each material, then their common refinement, in no particular order.
/// Returns the clusters as they are where nothing takes light away.
std::vector<std::vector<int>> split_by_losses(std::vector<std::vector<int>> clusters, const scene::Scene& scene,
                                              int reflections, double most);

} // namespace nephroid::photons
