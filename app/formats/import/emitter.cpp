// SPDX-License-Identifier: Apache-2.0
#include "formats/import/emitter.h"

#include "scene/ray.h"

#include <numbers>
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

double ellipsoid_area(const glm::dmat3& to_world) {
  constexpr int count = 4096;
  const glm::dmat3 cofactor(glm::cross(to_world[1], to_world[2]), glm::cross(to_world[2], to_world[0]),
                            glm::cross(to_world[0], to_world[1]));
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += glm::length(cofactor * scene::even_direction(i, count));
  return 4 * std::numbers::pi * sum / count;
}

} // namespace nephroid::formats
