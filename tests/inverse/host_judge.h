// SPDX-License-Identifier: Apache-2.0
// The judge's rays once more, on the host and in double precision: what the kernel is held against.
#pragma once
#include "inverse/judge.h"
#include "optics/fresnel.h"
#include "scene/bvh.h"
#include "scene/ray.h"

#include <algorithm>
#include <limits>

namespace nephroid::test {

using namespace inverse;

inline glm::dvec3 outward_normal(const scene::Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return glm::normalize(glm::cross(b - a, c - a));
}

inline WayOut follow_on_host(const Solid& solid, const scene::Bvh& bvh, double n, glm::dvec3 from,
                             glm::dvec3 direction) {
  WayOut way{from, glm::normalize(direction), 1, 0, false};
  std::uint32_t leaves = scene::no_primitive;
  for (int surfaces = 0; surfaces < 16; ++surfaces) {
    const auto hit =
        scene::closest_hit(bvh, way.from, way.direction, {}, std::numeric_limits<double>::infinity(), leaves);
    if (!hit) {
      if (way.direction.z >= 0) way.part = 0;
      return way;
    }
    way.from += hit->t * way.direction;
    leaves = hit->primitive;
    if (solid.parts[leaves] == Part::side) break;
    way.met_wall = way.met_wall || solid.parts[leaves] == Part::wall;
    glm::dvec3 normal = outward_normal(solid.mesh, leaves);
    const bool enters = glm::dot(normal, way.direction) < 0;
    if (!enters) normal = -normal;
    const double before = enters ? 1 : n, behind = enters ? n : 1,
                 cos_i = std::min(1.0, -glm::dot(normal, way.direction));
    if (const auto cos_t = optics::refracted_cosine(cos_i, before, behind)) {
      const double reflected = way.part * optics::fresnel_reflectance(cos_i, before, behind);
      way.reflected += reflected;
      way.part -= reflected;
      const double ratio = before / behind;
      way.direction = glm::normalize(ratio * way.direction + (ratio * cos_i - *cos_t) * normal);
    } else
      way.direction = glm::normalize(way.direction + 2 * cos_i * normal);
  }
  way.part = 0;
  return way;
}

} // namespace nephroid::test
