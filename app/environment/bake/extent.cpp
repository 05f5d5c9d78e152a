// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/extent.h"

#include "scene/bvh.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::environment {
namespace {

/// The point of a triangle nearest to the origin: in its plane where the foot lies in it, else on the nearest edge.
glm::dvec3 nearest_point(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const auto beyond = [&](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(glm::cross(q - p, -p), normal) < 0; };
  if (glm::dot(normal, normal) > 0 && !beyond(a, b) && !beyond(b, c) && !beyond(c, a))
    return glm::dot(a, normal) / glm::dot(normal, normal) * normal;
  const auto of_edge = [](const glm::dvec3& p, const glm::dvec3& q) {
    const glm::dvec3 way = q - p;
    const double length2 = glm::dot(way, way), along = length2 > 0 ? std::clamp(-glm::dot(p, way) / length2, 0.0, 1.0) : 0;
    return p + along * way;
  };
  const auto nearer = [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(q, q) < glm::dot(p, p) ? q : p; };
  return nearer(nearer(of_edge(a, b), of_edge(b, c)), of_edge(c, a));
}

/// A triangle or an ellipsoid.
struct Piece {
  double nearest = 0; ///< no point of it is nearer to the middle
  std::uint32_t object = 0, primitive = 0;
};

std::array<glm::dvec3, 3> corners(const scene::Scene& scene, std::uint32_t triangle)
{
  const glm::uvec3& t = scene.geometry.triangles[triangle];
  return {scene.geometry.positions[t.x], scene.geometry.positions[t.y], scene.geometry.positions[t.z]};
}

/// Where the middle is as seen from where the ellipsoid is the unit sphere.
glm::dvec3 middle_from(const scene::Ellipsoid& ellipsoid)
{
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 way = -glm::dvec3(ellipsoid.centre);
  return {glm::dot(rows[0], way), glm::dot(rows[1], way), glm::dot(rows[2], way)};
}

/// What is |u| - 1 off the unit sphere is at least as many shortest half axes off the ellipsoid.
double nearest_of(const scene::Ellipsoid& ellipsoid)
{
  return scene::shortest_half_axis(ellipsoid) * std::abs(glm::length(middle_from(ellipsoid)) - 1);
}

/// Points of the ellipsoid, first the one towards the middle.
std::vector<glm::dvec3> points_of(const scene::Ellipsoid& ellipsoid)
{
  constexpr int count = 256;
  std::vector<glm::dvec3> points;
  const auto add = [&](const glm::dvec3& unit) {
    glm::dvec3 point = ellipsoid.centre;
    for (int k = 0; k < 3; ++k) point += unit[k] * glm::dvec3(ellipsoid.half_axes[static_cast<std::size_t>(k)]);
    points.push_back(point);
  };
  const glm::dvec3 middle = middle_from(ellipsoid);
  if (middle != glm::dvec3(0)) add(glm::normalize(middle));
  for (int i = 0; i < count; ++i) add(scene::even_direction(i, count));
  return points;
}

/// Some points of it, first the one nearest to the middle.
std::vector<glm::dvec3> points_of(const scene::Scene& scene, const Piece& piece)
{
  const std::size_t triangles = scene.geometry.triangles.size();
  if (piece.primitive >= triangles) return points_of(scene.geometry.ellipsoids[piece.primitive - triangles]);
  const auto [a, b, c] = corners(scene, piece.primitive);
  return {nearest_point(a, b, c), a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0};
}

/// Whether a closed object encloses p: a ray from there meets its surface an odd number of times.
bool encloses(const scene::Scene& scene, const scene::Bvh& bvh, std::size_t object, const glm::dvec3& p)
{
  if (glm::distance(p, glm::dvec3(scene.objects[object].bounds.centre)) > scene.objects[object].bounds.radius) return false;
  static const glm::dvec3 direction = glm::normalize(glm::dvec3(0.4713, 0.7921, -0.3877)); // along no edge that people draw
  const scene::CountsPrimitive of_object = [&](std::uint32_t primitive) { return scene.object_of_primitive[primitive] == object; };
  bool inside = false;
  glm::dvec3 from = p;
  std::uint32_t leaves = scene::no_primitive;
  while (const std::optional<scene::RayHit> hit =
             closest_hit(bvh, from, direction, of_object, std::numeric_limits<double>::infinity(), leaves)) {
    inside = !inside;
    from += hit->t * direction;
    leaves = hit->primitive;
  }
  return inside;
}

/// Of the pieces that are not inside other glass; of all where there are no others.
double nearest_outside(const scene::Scene& scene, std::vector<Piece> pieces)
{
  if (scene.objects.size() == 1) return std::ranges::min(pieces, {}, &Piece::nearest).nearest;
  std::ranges::sort(pieces, {}, &Piece::nearest);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  const auto is_buried = [&](const glm::dvec3& p, std::size_t object) {
    for (std::size_t other = 0; other < scene.objects.size(); ++other)
      if (other != object && scene.objects[other].closed &&
          material_of(scene, scene.objects[other]).type == scene::Material::Type::dielectric && encloses(scene, bvh, other, p))
        return true;
    return false;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) {
    if (piece.nearest >= nearest) break;
    const std::vector<glm::dvec3> points = points_of(scene, piece);
    if (!is_buried(points.front(), piece.object)) return piece.nearest;
    for (const glm::dvec3& point : points)
      if (glm::length(point) < nearest && !is_buried(point, piece.object)) nearest = glm::length(point);
  }
  return std::isinf(nearest) ? pieces.front().nearest : nearest;
}

} // namespace

Extent extent_of(const scene::Scene& scene)
{
  Extent extent{.middle_inside = false};
  std::vector<Piece> pieces;
  const auto triangles = static_cast<std::uint32_t>(scene.geometry.triangles.size());
  for (std::uint32_t i = 0; i < scene.object_of_primitive.size(); ++i) {
    Piece piece{0, scene.object_of_primitive[i], i};
    if (i < triangles) {
      const auto [a, b, c] = corners(scene, i);
      piece.nearest = glm::length(nearest_point(a, b, c));
      extent.farthest = std::max({extent.farthest, glm::length(a), glm::length(b), glm::length(c)});
    } else {
      const scene::Ellipsoid& ellipsoid = scene.geometry.ellipsoids[i - triangles];
      piece.nearest = nearest_of(ellipsoid);
      extent.farthest = std::max(extent.farthest, glm::length(glm::dvec3(ellipsoid.centre)) + scene::longest_half_axis(ellipsoid));
      extent.middle_inside = extent.middle_inside || contains(ellipsoid, glm::dvec3(0));
    }
    pieces.push_back(piece);
  }
  for (const scene::Object& object : scene.objects)
    if (scene::winding_number(scene.geometry, object.first_triangle, object.triangle_count, glm::dvec3(0)) > 0.5)
      extent.middle_inside = true;
  extent.nearest = nearest_outside(scene, std::move(pieces));
  return extent;
}

} // namespace nephroid::environment
