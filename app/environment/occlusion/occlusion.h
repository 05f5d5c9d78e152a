// SPDX-License-Identifier: Apache-2.0
// How much of each light reaches the object, past what stands around it (kernels/environment/visible.cl): Algorithm 3.4
// of the thesis, but looked at from all over the object.
#pragma once
#include "environment/occlusion/samples.h"
#include "tracing/world.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::environment {

/// What is seen of a light.
struct VisibleLight {
  glm::dvec3 flux{0};      ///< as Region::flux, which it is where nothing stands before the light
  glm::dvec3 direction{0}; ///< as Region::direction: the mean of what is seen, as the cube has it. Where nothing is
                           ///< seen, the region's own
};

/// All lights of a segmentation as they are where nothing is in the way.
std::vector<VisibleLight> whole_lights(const Segmentation& segmentation);

/// Which directions lead past all that stands around the object.
class Visibility {
public:
  /// Of each direction, whether nothing stands there as seen from one of some points: neighbours in the list of
  /// directions look from points that are far from each other. Glass and mirrors hide light as everything does.
  /// surroundings: surroundings_world, on the same device. rotate_deg: how directions are turned first. from: a power
  /// of 2 of them, in the scene's coordinates.
  std::vector<std::uint8_t> free(tracing::World& surroundings, const compute::Buffer<shared::float4>& directions,
                                 double rotate_deg, const std::vector<glm::dvec3>& from);

private:
  compute::Buffer<std::uint8_t> seen_;
  compute::Defines defines_; ///< that the kernel is made with
  compute::Kernel kernel_;
};

/// Regions are the segmentation's, whatever stands before them. Flux and direction change with what is hidden, little
/// by little, so no caustic jumps. (The thesis keeps directions. A light that the horizon halves then shines from too
/// low.)
class Occlusion {
public:
  /// cube: that the segmentation was made of. Both may go afterwards. Throws failed where the device has not enough
  /// memory.
  Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube);

  /// Of each light, what Visibility sees from some points, each of which looks at other cells of the light: best
  /// surface_points of the object. From its middle alone an edge before the sun would hide all at once. rotate_deg: how
  /// the map is turned.
  std::vector<VisibleLight> visible_lights(tracing::World& surroundings, double rotate_deg,
                                           const std::vector<glm::dvec3>& from);

private:
  std::vector<VisibleLight> whole_;
  std::vector<LightSample> samples_;
  compute::Buffer<shared::float4> directions_;
  Visibility visibility_;
};

/// What stands around the object whose caustics are shown: what hides the environment from it, and what its caustics
/// fall on. That is the scene without the caster, in the same coordinates: the other objects with their geometry, the
/// materials and the camera. It has no lights, no environment and no warnings, which may be large and which nobody asks
/// of it. caster: indices into scene.objects, as Caster::objects; the others keep their order.
scene::Scene without_caster(const scene::Scene& scene, const std::vector<std::size_t>& caster);

/// The surroundings on a device, with their tree. Throws failed where the device has not enough memory.
tracing::World surroundings_world(const mpi::RankContext& context, const scene::Scene& surroundings);

} // namespace nephroid::environment
