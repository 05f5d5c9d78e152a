// SPDX-License-Identifier: Apache-2.0
// Meshes whose vertices move along their normals: bodies that reach into others.
#include "formats/import/dielectrics.h"

namespace nephroid::formats {

void reach_out(scene::Mesh& body, const std::set<Place>* places) {
  scene::Mesh even = body;
  scene::compute_smooth_normals(even);
  glm::vec3 low(1e30f), high(-1e30f);
  for (const glm::vec3& p : body.positions) low = glm::min(low, p), high = glm::max(high, p);
  const float distance = static_cast<float>(reach) * glm::length(high - low);
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    if (!places || places->contains(place_of(body.positions[i]))) body.positions[i] += distance * even.normals[i];
}

} // namespace nephroid::formats
