// SPDX-License-Identifier: Apache-2.0
#include "formats/import/emitter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nephroid::formats {

Emitter emitter_of(const scene::Mesh& mesh, const glm::dmat4& to_world) {
  Emitter e;
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : mesh.positions) points.emplace_back(to_world * glm::dvec4(glm::dvec3(p), 1));
  const double turn = glm::determinant(glm::dmat3(to_world)) < 0 ? -1 : 1;
  double squarest = 2;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = points[t.x], b = points[t.y], c = points[t.z], n = 0.5 * turn * glm::cross(b - a, c - a);
    e.normal += n;
    e.area += glm::length(n);
    e.centre += glm::length(n) * (a + b + c) / 3.0;
    for (const auto& [u, v] : {std::pair(b - a, c - a), std::pair(c - b, a - b), std::pair(a - c, b - c)}) {
      const double product = glm::length(u) * glm::length(v),
                   cosine = product > 0 ? std::abs(glm::dot(u, v)) / product : 2;
      if (cosine < squarest) squarest = cosine, e.edge = glm::normalize(u);
    }
  }
  if (!(e.area > 0)) return e;
  e.centre /= e.area;
  e.flat = glm::length(e.normal) > (1 - 1e-6) * e.area;
  if (!e.flat) return e;
  e.normal = glm::normalize(e.normal);
  const glm::dvec3 other = glm::cross(e.normal, e.edge);
  glm::dvec2 low(1e30), high(-1e30);
  for (const glm::dvec3& p : points) {
    const glm::dvec2 q(glm::dot(p - e.centre, e.edge), glm::dot(p - e.centre, other));
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const glm::dvec2 box = high - low;
  e.rectangle = std::abs(box.x * box.y - e.area) < 1e-3 * e.area;
  const double shrink = std::sqrt(e.area / (box.x * box.y));
  e.size = {box.x * shrink, box.y * shrink};
  return e;
}

} // namespace nephroid::formats
