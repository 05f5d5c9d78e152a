// SPDX-License-Identifier: Apache-2.0
// Algorithm 3.4 of the thesis: how much of each light reaches the object, past what stands around it (kernels/environment/visible.cl).
#pragma once
#include "environment/occlusion/samples.h"
#include "tracing/world.h"

#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// Regions and directions are the segmentation's, whatever stands before them: only flux changes, so no caustic jumps.
class Occlusion {
public:
  /// cube: that the segmentation was made of. Both may go afterwards. Throws failed where the device has not enough memory.
  Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube);

  /// Of each light, what is seen from a point: as Region::flux, which it is where nothing stands before the light. Glass and mirrors hide
  /// light as everything does.
  /// surroundings: surroundings_world, on the same device. rotate_deg: how the map is turned. from: in the scene's coordinates, best the
  /// middle of the object.
  std::vector<glm::dvec3> visible_flux(tracing::World& surroundings, double rotate_deg, const glm::dvec3& from);

private:
  /// Of each sample, whether nothing stands before it.
  std::vector<std::uint8_t> trace(tracing::World& surroundings, double rotate_deg, const glm::dvec3& from);

  std::vector<glm::dvec3> light_flux_, sample_flux_;
  compute::Buffer<shared::float4> directions_;
  compute::Buffer<std::uint8_t> seen_;
  compute::Defines defines_; ///< that the kernel is made with
  compute::Kernel kernel_;
};

} // namespace nephroid::environment
