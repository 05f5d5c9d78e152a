// SPDX-License-Identifier: Apache-2.0
// Algorithm 3.4 of the thesis: how much of each light reaches the object, past what stands around it (kernels/environment/visible.cl).
#pragma once
#include "environment/occlusion/samples.h"
#include "tracing/world.h"

#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// What is seen of a light.
struct VisibleLight {
  glm::dvec3 flux{0};      ///< as Region::flux, which it is where nothing stands before the light
  glm::dvec3 direction{0}; ///< as Region::direction: the mean of what is seen, as the cube has it. Where nothing is seen, the region's own
  double spread_deg = 0;   ///< as Region::spread_deg
};

/// All lights of a segmentation as they are where nothing is in the way.
std::vector<VisibleLight> whole_lights(const Segmentation& segmentation);

/// Which directions lead past all that stands around the object.
class Sight {
public:
  /// Of each direction, whether nothing stands there as seen from a point. Glass and mirrors hide light as everything does.
  /// surroundings: surroundings_world, on the same device. rotate_deg: how directions are turned first. from: in the scene's coordinates.
  std::vector<std::uint8_t> free(tracing::World& surroundings, const compute::Buffer<shared::float4>& directions, double rotate_deg,
                                 const glm::dvec3& from);

private:
  compute::Buffer<std::uint8_t> seen_;
  compute::Defines defines_; ///< that the kernel is made with
  compute::Kernel kernel_;
};

/// Regions are the segmentation's, whatever stands before them. Flux and direction change with what is hidden, little by little, so no
/// caustic jumps. (The thesis keeps directions. A light that the horizon halves then shines from too low.)
class Occlusion {
public:
  /// cube: that the segmentation was made of. Both may go afterwards. Throws failed where the device has not enough memory.
  Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube);

  /// Of each light, what is seen from a point, as Sight sees it: best the middle of the object. rotate_deg: how the map is turned.
  std::vector<VisibleLight> visible_lights(tracing::World& surroundings, double rotate_deg, const glm::dvec3& from);

  /// A part of each light instead of all of it: the cell of its region that is the `pass`th of a sequence over all of them, with as much
  /// light as all cells would have were they like this one; none where visible_lights() found the cell hidden. The mean over passes goes
  /// towards all light that is seen, each part from its own direction.
  std::vector<VisibleLight> drawn_lights(std::uint32_t pass) const;

private:
  std::vector<VisibleLight> whole_;
  std::vector<LightSample> samples_;
  std::vector<std::uint8_t> is_seen_; ///< of each sample; empty: all are
  compute::Buffer<shared::float4> directions_;
  Sight sight_;
};

} // namespace nephroid::environment
