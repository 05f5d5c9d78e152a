// SPDX-License-Identifier: Apache-2.0
// Directions in which visibility is tested: some of each light's rectangle, each with its part of the light's flux. And
// the points that they are tested from: points of the object, which a shadow's edge passes one after the other.
#pragma once
#include "environment/segment/segment.h"
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace nephroid::environment {

/// 32 x 32 for up to 256 lights. More lights have fewer each, a power of 2, so that there are at most 2^18 in all.
std::size_t samples_per_light(std::size_t lights);

struct LightSample {
  glm::dvec3 direction{0}; ///< unit; where the light comes from, as the cube has it
  glm::dvec3 flux{0};      ///< its cell's, as Region::flux
};

/// samples_per_light(lights) samples for each light, light after light. Their sum is the light's flux; the flux of
/// dropped regions is spread evenly over them. The cells of a light tile its rectangle and weigh the same: each has
/// 1/1024 of the flux where the map is grey, else the mean of its parts of red, green and blue is 1/1024. So few
/// samples lie in the dark and many in a sun, and an occluder that hides one more changes no channel of the light by
/// more than 3/1024. A texel's flux is even in s and t. cube: the one that the segmentation was made from.
std::vector<LightSample> sample_lights(const Segmentation& segmentation, const CubeMap& cube);

/// Points of the surface of some objects of a scene, in its coordinates. They are spread evenly by area, nearly so on
/// ellipsoids other than spheres. Neighbours in the list are near each other. objects: indices; one has a surface.
std::vector<glm::dvec3> surface_points(const scene::Scene& scene, const std::vector<std::size_t>& objects,
                                       std::size_t count);

} // namespace nephroid::environment
