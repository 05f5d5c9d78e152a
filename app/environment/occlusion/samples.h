// SPDX-License-Identifier: Apache-2.0
// Where to look for what hides the environment: a few directions of each light's rectangle, each with its part of the
// light's flux. And where to look from: points of the object, which a shadow's edge passes one after the other.
#pragma once
#include "environment/segment/segment.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace nephroid::environment {

/// 32 x 32, of up to 256 lights. Of more there are fewer each, a power of 2, so that all together are at most 2^18.
std::size_t samples_per_light(std::size_t lights);

struct LightSample {
  glm::dvec3 direction{0}; ///< unit; where the light comes from, as the cube has it
  glm::dvec3 flux{0};      ///< of its cell; as Region::flux
};

/// samples_per_light(lights) of each light, light after light. Their sum is the light's flux; what it has of regions
/// that were dropped is even among them. The cells of a light tile its rectangle, and all have the same flux: each has
/// 1/1024 of that where the map is grey, else the mean of its parts of red, green and blue is 1/1024. So few samples
/// look at the dark, many at a sun, and an occluder that hides one more changes no channel of the light by more than
/// 3/1024. A texel's flux is even in s and t. cube: that the segmentation was made of.
std::vector<LightSample> sample_lights(const Segmentation& segmentation, const CubeMap& cube);

/// Points of the surface of some objects of a scene, in its coordinates: in triangles evenly by area, of ellipsoids
/// other than spheres nearly so. Neighbours in the list are near each other. objects: indices into scene.objects, of
/// which one has a surface. count: at least 1.
std::vector<glm::dvec3> surface_points(const scene::Scene& scene, const std::vector<std::size_t>& objects,
                                       std::size_t count);

} // namespace nephroid::environment
