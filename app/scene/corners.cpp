// SPDX-License-Identifier: Apache-2.0
#include "scene/corners.h"

#include "base/error.h"

#include <fmt/format.h>

namespace nephroid::scene {

std::span<const glm::uvec3> triangles_of(const Scene& scene, const Object& object)
{
  const std::span<const glm::uvec3> all = scene.geometry.triangles;
  if (object.first_triangle > all.size() || object.triangle_count > all.size() - object.first_triangle)
    throw failed(scene.source, fmt::format("object '{}' has triangles that the scene does not hold", object.name),
                 fmt::format("expected triangles {} to {} among {}", object.first_triangle,
                             std::uint64_t{object.first_triangle} + object.triangle_count, all.size()));
  return all.subspan(object.first_triangle, object.triangle_count);
}

Bounds enclosing(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

Bounds bounds_of(const Scene& scene, const Object& object)
{
  Bounds bounds;
  for_each_corner(scene, object, [&](const glm::dvec3& corner) { bounds = enclosing(bounds, {corner, corner}); });
  return bounds;
}

} // namespace nephroid::scene
