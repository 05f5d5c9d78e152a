// SPDX-License-Identifier: Apache-2.0
// The map of a caustic sphere: a square whose texels all have the same solid angle, by the octahedral map of Clarberg (2008, "Fast
// equal-area mapping of the (hemi)sphere using SIMD"). kernels/environment/sphere_map.h has the same in single precision.
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <numbers>

namespace nephroid::environment {

struct SphereMap {
  int side = 1; ///< texels across and down

  std::size_t texels() const { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }
  double solid_angle() const { return 4 * std::numbers::pi / static_cast<double>(texels()); } ///< of a texel, in steradians
  /// Row after row. direction: of any length but 0.
  std::size_t texel(const glm::dvec3& direction) const;
  /// The unit direction of a texel's middle.
  glm::dvec3 direction(std::size_t texel) const;
};

} // namespace nephroid::environment
