// SPDX-License-Identifier: Apache-2.0
// All light that engine 2 knows: parallel light from far away. That is what an environment is cut into (segment/), and the directional
// lights of a scene.
#pragma once
#include "environment/occlusion/occlusion.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <vector>

namespace nephroid::environment {

struct DistantLight {
  glm::dvec3 direction{0, -1, 0}; ///< unit, the way the light goes, in the scene
  glm::dvec3 irradiance{0};       ///< on a plane that faces it: linear sRGB, W/m^2 of Y
  double spread_deg = 0;          ///< how wide it is: as Region::spread_deg
};

/// Of each light of the environment, in their order.
std::vector<DistantLight> environment_lights(const std::vector<VisibleLight>& lights, double rotate_deg);

/// The scene's directional lights. Throws bad_input at FILE#/scene/lights/INDEX for a light of another type: it has no one direction.
std::vector<DistantLight> lamps(const scene::Scene& scene);

/// Each light's part that Sight sees from points of the object. surroundings, from: as Sight has them.
std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings, const std::vector<glm::dvec3>& from);

} // namespace nephroid::environment
