// SPDX-License-Identifier: Apache-2.0
// Where to look for what hides the environment: a few directions of each light's rectangle, each with its part of the light's flux.
#pragma once
#include "environment/segment/segment.h"

#include <cstddef>
#include <vector>

namespace nephroid::environment {

/// Cells of a light's rectangle: 32 x 32.
inline constexpr std::size_t samples_per_light = 1024;

struct LightSample {
  glm::dvec3 direction{0}; ///< unit; where the light comes from, as the cube has it
  glm::dvec3 flux{0};      ///< of its cell; as Region::flux
};

/// samples_per_light of each light, light after light. Their sum is the light's flux; regions that were dropped count in each sample of the
/// light that has their flux. The cells of a light tile its rectangle, and all have the same flux: where the map is grey that of each is
/// 1/1024, else the mean of its parts of red, green and blue is. So few samples look at the dark, many at a sun, and no occluder that
/// hides one more changes the light by more than 3/1024 of a channel. A texel's flux is even in its s and t.
/// cube: that the segmentation was made of.
std::vector<LightSample> sample_lights(const Segmentation& segmentation, const CubeMap& cube);

} // namespace nephroid::environment
