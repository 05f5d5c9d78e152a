// SPDX-License-Identifier: Apache-2.0
// Which wavelengths glass and mirrors take away alike (tracing::loss_coefficients).
#pragma once
#include "optics/wavelength.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::spectral {

/// The most by which exp(-a s) and exp(-b s) differ for s in 0..longest; a, b >= 0.
double largest_difference(double a, double b, double longest);

/// Splits clusters so that, in each, what one material leaves of two wavelengths differs by at most `most`, whatever the length: of glass
/// up to twice the diagonal of the box about all objects of it, on a mirror up to `reflections` times. In each cluster the fewest parts for
/// each material, then their common refinement, in no particular order. Returns the clusters as they are where nothing takes light away.
std::vector<std::vector<int>> split_by_losses(std::vector<std::vector<int>> clusters, const scene::Scene& scene, int reflections,
                                              double most);

} // namespace nephroid::spectral
