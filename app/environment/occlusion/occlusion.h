// SPDX-License-Identifier: Apache-2.0
// How much of each light reaches the object, past what stands around it (kernels/environment/visible.cl). It is the
// thesis' Algorithm 3.4, but tests from points all over the object.
#pragma once
#include "environment/occlusion/samples.h"
#include "tracing/world.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// The part of a light that is seen.
struct VisibleLight {
  glm::dvec3 flux{0};      ///< as Region::flux; equal to it where nothing hides the light
  glm::dvec3 direction{0}; ///< as Region::direction, in the cube's axes: the mean direction of what is seen; the
                           ///< region's own where nothing is seen
};

/// All lights of a segmentation, with nothing hidden.
std::vector<VisibleLight> whole_lights(const Segmentation& segmentation);

/// Finds which directions lead past all that stands around the object.
class Visibility {
public:
  /// [direction]: whether nothing hides it from one of the points `from`. Neighbours in the list of directions start
  /// from points that are far apart. Glass and mirrors hide light as everything else does. surroundings:
  /// surroundings_world, on the same device. rotate_deg: directions are first turned by this. from: points in the
  /// scene's coordinates; their number is a power of 2.
  std::vector<std::uint8_t> free(tracing::World& surroundings, const compute::Buffer<shared::float4>& directions,
                                 double rotate_deg, const std::vector<glm::dvec3>& from);

private:
  compute::Buffer<std::uint8_t> seen_;
  compute::Defines defines_; ///< the kernel's
  compute::Kernel kernel_;
};

/// What is seen of the segmentation's lights. Flux and direction change little by little with what is hidden, so no
/// caustic jumps. (The thesis keeps directions; a light that the horizon halves then shines from too low.)
class Occlusion {
public:
  /// cube: the segmentation's. Neither need outlive the call. Throws failed where the device has not enough memory.
  Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube);

  /// What Visibility sees of each light from the points `from`, each of which tests other cells of the light. They are
  /// best surface_points: from the middle alone, an edge before the sun would hide all of it at once.
  std::vector<VisibleLight> visible_lights(tracing::World& surroundings, double rotate_deg,
                                           const std::vector<glm::dvec3>& from);

private:
  std::vector<VisibleLight> whole_;
  std::vector<LightSample> samples_;
  compute::Buffer<shared::float4> directions_;
  Visibility visibility_;
};

/// The scene without the caster, in the same coordinates: what hides the environment from it, and what its caustics
/// fall on. It has the other objects with their geometry, in the same order, the materials and the camera, but no
/// lights, environment and warnings. caster: Caster::objects.
scene::Scene without_caster(const scene::Scene& scene, const std::vector<std::size_t>& caster);

/// The surroundings on a device, with their tree. Throws failed where the device has not enough memory.
tracing::World surroundings_world(const mpi::RankContext& context, const scene::Scene& surroundings);

} // namespace nephroid::environment
