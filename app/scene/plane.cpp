// SPDX-License-Identifier: Apache-2.0
#include "scene/plane.h"

#include <algorithm>
#include <cmath>

namespace nephroid::scene {

std::optional<Plane> plane_of(const Scene& scene, const Object& object) {
  if (object.triangle_count == 0) return std::nullopt;
  const glm::uvec3 first = triangles_of(scene, object).front();
  const auto corner = [&](std::uint32_t vertex) { return glm::dvec3(scene.geometry.positions[vertex]); };
  Plane plane{corner(first.x),
              glm::normalize(glm::cross(corner(first.y) - corner(first.x), corner(first.z) - corner(first.x))), 0};
  double largest = 0, highest = 0;
  for_each_corner(scene, object, [&](const glm::dvec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    highest = std::max(highest, std::abs(plane.height(p)));
  });
  plane.tolerance = 1e-6 * largest;
  return highest <= plane.tolerance ? std::optional(plane) : std::nullopt;
}

} // namespace nephroid::scene
