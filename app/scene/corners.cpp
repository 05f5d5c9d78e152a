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

std::span<const Ellipsoid> ellipsoids_of(const Scene& scene, const Object& object)
{
  const std::span<const Ellipsoid> all = scene.geometry.ellipsoids;
  if (object.first_ellipsoid + object.ellipsoid_count > all.size())
    throw failed(scene.source, fmt::format("object '{}' has ellipsoids that the scene does not hold", object.name));
  return all.subspan(object.first_ellipsoid, object.ellipsoid_count);
}

Bounds enclosing(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

Bounds bounds_of(const Ellipsoid& ellipsoid)
{
  const glm::dvec3 centre = ellipsoid.centre, half = half_extent(ellipsoid);
  return {centre - half, centre + half};
}

Bounds bounds_of(const Scene& scene, const Object& object)
{
  Bounds bounds;
  for_each_corner_index(scene, object, [&](std::uint32_t vertex) {
    const glm::dvec3 corner = scene.geometry.positions[vertex];
    bounds = enclosing(bounds, {corner, corner});
  });
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object)) bounds = enclosing(bounds, bounds_of(ellipsoid));
  return bounds;
}

} // namespace nephroid::scene
