// SPDX-License-Identifier: Apache-2.0
// Where to look from at what hides the environment: points of the object, which a shadow's edge passes one after the other.
#pragma once
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace nephroid::environment {

/// Points of the surface of some objects of a scene, in its coordinates: in triangles evenly by area, of ellipsoids other than spheres
/// nearly so. Neighbours in the list are near each other. objects: indices into scene.objects, of which one has a surface. count: at
/// least 1.
std::vector<glm::dvec3> surface_points(const scene::Scene& scene, const std::vector<std::size_t>& objects, std::size_t count);

} // namespace nephroid::environment
