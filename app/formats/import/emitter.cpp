// SPDX-License-Identifier: Apache-2.0
#include "formats/import/emitter.h"

#include <vector>

namespace nephroid::formats {

Emitter emitter_of(const scene::Mesh& mesh, const glm::dmat4& to_world) {
  Emitter e;
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : mesh.positions) points.emplace_back(to_world * glm::dvec4(glm::dvec3(p), 1));
  const double turn = glm::determinant(glm::dmat3(to_world)) < 0 ? -1 : 1;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = points[t.x], b = points[t.y], c = points[t.z], n = 0.5 * turn * glm::cross(b - a, c - a);
    e.normal += n;
    e.area += glm::length(n);
    e.centre += glm::length(n) * (a + b + c) / 3.0;
  }
  if (!(e.area > 0)) return e;
  e.centre /= e.area;
  e.flat = glm::length(e.normal) > (1 - 1e-6) * e.area;
  if (e.flat) e.normal = glm::normalize(e.normal);
  return e;
}

} // namespace nephroid::formats
