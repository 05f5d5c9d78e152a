// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/plate.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace nephroid::inverse {

std::optional<std::size_t> put_on_shelves(const glm::dvec2& plate, double gap, std::vector<PlatePart>& bodies) {
  constexpr double slack = 1e-6; // sums are rounded
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bodies[a].size.y > bodies[b].size.y; });
  double left = gap, top = gap, shelf = 0; // from the plate's upper left corner
  for (const std::size_t i : order) {
    PlatePart& body = bodies[i];
    if (left + body.size.x + gap > plate.x + slack && shelf > 0) {
      top += shelf + gap;
      left = gap;
      shelf = 0;
    }
    if (left + body.size.x + gap > plate.x + slack || top + body.size.y + gap > plate.y + slack) return i;
    body.middle = {left + body.size.x / 2 - plate.x / 2, plate.y / 2 - top - body.size.y / 2};
    left += body.size.x + gap;
    shelf = std::max(shelf, body.size.y);
  }
  return std::nullopt;
}

scene::Mesh plate_mesh(const std::vector<scene::Mesh>& meshes, const std::vector<PlatePart>& places) {
  scene::Mesh plate;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const scene::Mesh& mesh = meshes[i];
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const glm::vec3& p : mesh.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const auto first = static_cast<glm::uint>(plate.positions.size());
    const glm::dvec3 by(places[i].middle - glm::dvec2(low + high) / 2.0, -high.z);
    for (const glm::vec3& p : mesh.positions) plate.positions.emplace_back(glm::dvec3(p) + by);
    for (const glm::uvec3& t : mesh.triangles) plate.triangles.push_back(t + first);
  }
  return plate;
}

} // namespace nephroid::inverse
