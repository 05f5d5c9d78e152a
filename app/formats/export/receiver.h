// SPDX-License-Identifier: Apache-2.0
// The light through glass and by way of mirrors that falls on a flat matt object, as a picture laid over it.
#pragma once
#include "scene/scene.h"

#include <vector>

namespace nephroid::formats {

/// A rectangle about a flat matt object, seen from the side that the glass and mirrors are on. In the scene's
/// coordinates.
struct Receiver {
  int object = 0; ///< of Scene::objects
  glm::dvec3 centre{0};
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}; ///< unit; right x up looks to that side
  double width = 0, height = 0;           ///< along right and up
  bool is_front = true;                   ///< whether the triangles' front is on that side

  glm::dvec3 normal() const { return glm::cross(right, up); }
};

/// All flat matt objects as receivers, in the order of the scene.
std::vector<Receiver> receivers_of(const scene::Scene& scene);

/// The scene with a camera for the light that a receiver gets, not for what an eye sees of it. Where engine 1 renders
/// that with a white of 1 and no photon maps, the layer "caustic" is the irradiance in W/m^2 over pi, as linear sRGB
/// whose Y has no factor 683. longest: of the picture's edges, in pixels.
scene::Scene irradiance_view(scene::Scene scene, const Receiver& receiver, int longest);

} // namespace nephroid::formats
