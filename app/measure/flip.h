// SPDX-License-Identifier: Apache-2.0
// FLIP, the difference a person sees when flipping between two pictures, by its authors' own code (FLIP.h 1.7,
// BSD-3-Clause) at 67.02 pixels a degree. Andersson et al.: FLIP, HPG 2020; for HDR pictures, Eurographics 2021.
#pragma once
#include "measure/metrics.h"

#include <array>

namespace nephroid::measure {

/// The exposures (powers of two, in stops) at which HDR-FLIP looks: `count` of them from start to stop, both included.
struct Exposures {
  float start = 0, stop = 0;
  int count = 2;
};
/// From the reference: the first shows its largest luminance, the last its median, just below white. Both luminances
/// count as at least 2^-23 (the authors have that for the median only, and a black reference is undefined).
Exposures hdr_exposures(std::span<const float> reference_rgb);

/// LDR-FLIP of the clipped pictures, 0..1 a pixel. The pictures have the same size and finite values.
std::vector<float> flip_map(const Pixels& picture, const Pixels& reference);
/// HDR-FLIP: the largest error over the exposures, 0..1 a pixel. Negative values count as 0, as the authors have it.
std::vector<float> hdr_flip_map(const Pixels& picture, const Pixels& reference);

/// The colour map magma (Smith and van der Walt, CC0) that FLIP's maps are shown in: position 0..1, sRGB-encoded, 0..1.
std::array<float, 3> magma(double position);

} // namespace nephroid::measure
