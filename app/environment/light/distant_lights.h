// SPDX-License-Identifier: Apache-2.0
// All light that engine 2 knows: parallel light from far away. That is what an environment is cut into (segment/), and
// the directional lights of a scene. And which baked directions stand for a light, and how their caustic spheres are
// turned to fit it (thesis 3.2.1).
#pragma once
#include "environment/occlusion/occlusion.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::environment {

struct DistantLight {
  glm::dvec3 direction{0, -1, 0}; ///< unit, the way the light goes, in the scene
  glm::dvec3 irradiance{0};       ///< on a plane that faces it: linear sRGB, W/m^2 of Y
};

/// Of each light of the environment, in their order.
std::vector<DistantLight> environment_lights(const std::vector<VisibleLight>& lights, double rotate_deg);

/// The scene's directional lights. Throws bad_input at FILE#/scene/lights/INDEX for a light of another type: it has no
/// one direction.
std::vector<DistantLight> lamps(const scene::Scene& scene);

/// Each light's part that Visibility sees from points of the object. surroundings, from: as Visibility has them.
std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings,
                                      const std::vector<glm::dvec3>& from);

/// Caustics that one light makes by one baked direction: its spheres, turned so that they fit the light.
struct TurnedSet {
  glm::dmat3 to_bake{1}; ///< from the scene into the coordinates of that direction's spheres
  glm::dvec3 flux{0};    ///< linear sRGB: the light's irradiance on a plane that faces it, times the direction's weight
  int direction = 0;     ///< of the bake
};

struct NearDirection {
  int direction = 0; ///< of light_directions(count)
  double weight = 0; ///< above 0; all together 1
};

/// The baked directions about one that light goes in: where it comes from is a point of a face of the cube
/// (bake/bake.h), and those are the corners of its cell in the face's grid, with bilinear weights. 1 to 4; just itself
/// of a baked direction. travel: of any length but 0.
std::vector<NearDirection> near_directions(const glm::dvec3& travel, int count);

/// The shortest turn from one unit vector to another; half a turn about some axis across where they are opposite.
glm::dmat3 shortest_turn(const glm::dvec3& from, const glm::dvec3& to);

/// The sets of all lights. rotation: from the bake's coordinates to the scene's. count: of baked directions. Black
/// lights have none.
std::vector<TurnedSet> turned_sets(const std::vector<DistantLight>& lights, const glm::dmat3& rotation, int count);

} // namespace nephroid::environment
