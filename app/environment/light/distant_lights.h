// SPDX-License-Identifier: Apache-2.0
// Parallel light from far away, the only kind of light in engine 2: the lights that an environment is cut into
// (segment/) and the directional lights of a scene. And the baked directions that stand for a light (thesis 3.2.1).
#pragma once
#include "environment/occlusion/occlusion.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <vector>

namespace nephroid::environment {

struct DistantLight {
  glm::dvec3 direction{0, -1, 0}; ///< unit, the way the light goes, in the scene
  glm::dvec3 irradiance{0};       ///< on a plane that faces it: linear sRGB, W/m^2 of Y
};

/// The lights of the environment in the scene, in the same order.
std::vector<DistantLight> environment_lights(const std::vector<VisibleLight>& lights, double rotate_deg);

/// The scene's directional lights. Throws bad_input at FILE#/scene/lights/INDEX for a light of another type.
std::vector<DistantLight> lamps(const scene::Scene& scene);

/// The part of each light that Visibility sees from points of the object. surroundings, from: as in Visibility.
std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings,
                                      const std::vector<glm::dvec3>& from);

/// The caustics of one light by one baked direction: the direction's spheres, turned so that they fit the light.
struct TurnedSet {
  glm::dmat3 to_bake{1}; ///< from the scene into the coordinates of that direction's spheres
  glm::dvec3 flux{0};    ///< linear sRGB: the light's irradiance on a plane that faces it, times the direction's weight
  int direction = 0;     ///< the baked direction's number
};

struct NearDirection {
  int direction = 0; ///< index into light_directions(count)
  double weight = 0; ///< above 0; all sum to 1
};

/// The baked directions around one that light goes in. The light comes from a point of a face of the cube
/// (bake/bake.h); they are the corners of its cell in the face's grid, with bilinear weights.
std::vector<NearDirection> near_directions(const glm::dvec3& travel, int count);

/// The shortest turn from one unit vector to another; opposite ones take half a turn about some axis across them.
glm::dmat3 shortest_turn(const glm::dvec3& from, const glm::dvec3& to);

/// The sets of all lights that are not black. rotation: from the bake's coordinates to the scene's. count: of
/// directions of a shape. weights: Bake's.
std::vector<TurnedSet> turned_sets(const std::vector<DistantLight>& lights, const glm::dmat3& rotation, int count,
                                   const std::vector<double>& weights);

} // namespace nephroid::environment
