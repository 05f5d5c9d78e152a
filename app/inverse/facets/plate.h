// SPDX-License-Identifier: Apache-2.0
// Several objects on one plate, so that they are cut out of it in one go.
#pragma once
#include "scene/mesh.h"

#include <glm/glm.hpp>

namespace nephroid::inverse {

/// A rectangle on a plate, in millimetres from the plate's middle; y is up.
struct PlatePart {
  std::string name;
  glm::dvec2 size{0}, middle{0};
};

/// Puts rectangles, which are not turned, on shelves, the highest first, from the plate's upper edge down (next-fit
/// decreasing height: Coffman et al. 1980), with `gap` between them and at the rim. Returns the first that found no
/// place.
std::optional<std::size_t> put_on_shelves(const glm::dvec2& plate, double gap, std::vector<PlatePart>& bodies);

/// Joins all bodies in one mesh: each is moved to its place, with its front (its highest z) at z = 0.
scene::Mesh plate_mesh(const std::vector<scene::Mesh>& meshes, const std::vector<PlatePart>& places);

} // namespace nephroid::inverse
