// SPDX-License-Identifier: Apache-2.0
// The light through glass and by way of mirrors that falls on a flat matt object, as a picture laid over it.
#pragma once
#include "run/run.h"

#include <string>
#include <vector>

namespace nephroid::run {

/// A rectangle about a flat matt object, seen from the side that the glass and mirrors are on. In the scene's coordinates.
struct Receiver {
  int object = 0; ///< of Scene::objects
  glm::dvec3 centre{0};
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< unit; right x up looks to that side
  double width = 0, height = 0;           ///< along right and up
  bool is_front = true;                   ///< whether the triangles' front is on that side

  glm::dvec3 normal() const { return glm::cross(right, up); }
};

/// Of all flat matt objects, in the order of the scene.
std::vector<Receiver> receivers_of(const scene::Scene& scene);

/// The light that a receiver gets, not that which an eye sees: with a white of 1 the layer "caustic" is its irradiance in W/m^2 over pi, as
/// linear sRGB whose Y has no factor 683. prepared: of engine 1, with the layer "caustic" alone and no photon maps. longest: pixels.
Prepared light_on(const Prepared& prepared, const Receiver& receiver, int longest);

} // namespace nephroid::run
