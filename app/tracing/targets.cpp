// SPDX-License-Identifier: Apache-2.0
#include "tracing/targets.h"

#include "lights/lights.h"
#include "scene/ray.h"
#include "tracing/scales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace nephroid::tracing {
namespace {

using Triangles = std::vector<glm::uvec3>;

struct Piece {
  Triangles triangles;
  scene::Sphere sphere;
};

glm::vec3 centroid(const scene::Mesh& mesh, const glm::uvec3& corner) {
  return (mesh.positions[corner.x] + mesh.positions[corner.y] + mesh.positions[corner.z]) / 3.0f;
}

/// Two halves of equal count along the axis on which the centroids spread most.
std::pair<Piece, Piece> halves(const scene::Mesh& mesh, Triangles triangles) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
  for (const glm::uvec3& t : triangles)
    low = glm::min(low, centroid(mesh, t)), high = glm::max(high, centroid(mesh, t));
  const glm::vec3 extent = high - low;
  const int axis = extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
  struct Placed {
    float at;
    glm::uvec3 triangle;
  };
  std::vector<Placed> placed;
  placed.reserve(triangles.size());
  for (const glm::uvec3& t : triangles) placed.push_back({centroid(mesh, t)[axis], t});
  const auto half = static_cast<std::ptrdiff_t>(triangles.size() / 2);
  std::nth_element(placed.begin(), placed.begin() + half, placed.end(), [](const Placed& a, const Placed& b) {
    // Ties are broken by the corners, so that the halves do not depend on the library's way of sorting.
    return std::tuple(a.at, a.triangle.x, a.triangle.y, a.triangle.z) <
           std::tuple(b.at, b.triangle.x, b.triangle.y, b.triangle.z);
  });
  std::ranges::transform(placed, triangles.begin(), &Placed::triangle);
  const auto middle = triangles.begin() + half;
  Piece first{{triangles.begin(), middle}, {}}, second{{middle, triangles.end()}, {}};
  first.sphere = enclosing_sphere(mesh, first.triangles);
  second.sphere = enclosing_sphere(mesh, second.triangles);
  return {std::move(first), std::move(second)};
}

/// Spheres about slices of an ellipsoid across its longest half axis a; the longer it is for its thickness, the more
/// slices. With x in lengths of a, a slice from x to x + w lies within w a / 2 of its middle along the axis, and off it
/// within sqrt(1 - x'^2) times the next longest half axis, x' its least distance from the centre.
std::vector<scene::Sphere> slices(const scene::Ellipsoid& ellipsoid) {
  std::array<glm::dvec3, 3> axes{ellipsoid.half_axes[0], ellipsoid.half_axes[1], ellipsoid.half_axes[2]};
  std::ranges::sort(axes, [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a) > glm::length(b); });
  const double longest = glm::length(axes[0]), thick = glm::length(axes[1]);
  const int count = std::clamp(static_cast<int>(longest / thick), 1, static_cast<int>(max_targets));
  std::vector<scene::Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const double width = 2.0 / count, middle = -1 + (i + 0.5) * width,
                 nearest = std::max(0.0, std::abs(middle) - width / 2);
    const double radius =
        count == 1 ? longest : std::hypot(longest * width / 2, thick * std::sqrt(1 - nearest * nearest));
    spheres.push_back({ellipsoid.centre + glm::vec3(middle * axes[0]), static_cast<float>(radius * (1 + 1e-6))});
  }
  return spheres;
}

std::vector<Piece> piece_by_object(const scene::Scene& scene) {
  std::vector<Piece> pieces;
  for (const scene::Object& object : scene.objects) {
    if (is_empty(object) || !is_specular(material_of(scene, object).type)) continue;
    const auto triangles = triangles_of(scene, object);
    if (!triangles.empty()) pieces.push_back({{triangles.begin(), triangles.end()}, object.bounds});
    for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
      for (const scene::Sphere& sphere : slices(ellipsoid)) pieces.push_back({{}, sphere});
  }
  return pieces;
}

std::vector<scene::Sphere> spheres_of(const std::vector<Piece>& pieces) {
  std::vector<scene::Sphere> spheres;
  for (const Piece& piece : pieces) spheres.push_back(piece.sphere);
  return spheres;
}

} // namespace

scene::Sphere everything(const scene::Scene& scene) {
  std::vector<glm::vec3> points = extreme_points(scene.geometry);
  for (const scene::Light& light : scene.lights)
    if (light.object < 0) // whose surface is among them
      for (const glm::dvec3& place : lights::model(light).extent(scene, light)) points.emplace_back(place);
  const auto [low, high] = box_about(points);
  // The sphere is larger than it needs to be, so that no light is on its surface, and never a point.
  return {0.5f * (low + high), std::max(0.51f * glm::length(high - low), 1e-3f)};
}

// Each sphere's shadow is a disc. Points spread over it (Vogel's sunflower) count by 1 / (discs over the point).
double mean_shadow(const std::vector<scene::Sphere>& spheres) {
  constexpr int directions = 32, points = 64;
  constexpr double pi = std::numbers::pi, golden_angle = pi * 0.7639320225002103; // pi (3 - sqrt 5)
  static const std::array<glm::dvec2, points> disc = [] {
    std::array<glm::dvec2, points> places;
    for (int p = 0; p < points; ++p)
      places[static_cast<std::size_t>(p)] =
          std::sqrt((p + 0.5) / points) * glm::dvec2(std::cos(p * golden_angle), std::sin(p * golden_angle));
    return places;
  }();
  std::vector<glm::dvec2> centres(spheres.size());
  double sum = 0;
  for (int d = 0; d < directions; ++d) {
    const glm::dvec3 direction = scene::even_direction(d, directions);
    const glm::dvec3 x =
        glm::normalize(glm::cross(direction, std::abs(direction.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 y = glm::cross(direction, x);
    for (std::size_t i = 0; i < spheres.size(); ++i)
      centres[i] = {glm::dot(glm::dvec3(spheres[i].centre), x), glm::dot(glm::dvec3(spheres[i].centre), y)};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const double radius = spheres[i].radius;
      for (const glm::dvec2& offset : disc) {
        const glm::dvec2 place = centres[i] + radius * offset;
        int over = 1;
        for (std::size_t j = 0; j < spheres.size(); ++j) {
          const glm::dvec2 way = place - centres[j];
          over += j != i && glm::dot(way, way) <= double(spheres[j].radius) * spheres[j].radius;
        }
        sum += pi * radius * radius / (points * over);
      }
    }
  }
  return sum / directions;
}

std::vector<scene::Sphere> caustic_targets(const scene::Scene& scene) {
  std::vector<Piece> pieces = piece_by_object(scene);
  if (pieces.empty()) return {};
  if (pieces.size() > max_targets) {
    Triangles triangles;
    for (const Piece& piece : pieces) triangles.insert(triangles.end(), piece.triangles.begin(), piece.triangles.end());
    std::vector<scene::Ellipsoid> ellipsoids;
    for (const scene::Object& object : scene.objects)
      if (is_specular(material_of(scene, object).type))
        for (const scene::Ellipsoid& ellipsoid : ellipsoids_of(scene, object)) ellipsoids.push_back(ellipsoid);
    return {enclosing_sphere(scene.geometry, triangles, ellipsoids)};
  }
  std::vector<scene::Sphere> best = spheres_of(pieces);
  double best_shadow = mean_shadow(best);
  while (pieces.size() < max_targets) {
    const auto widest = std::ranges::max_element(pieces, [](const Piece& a, const Piece& b) {
      return (a.triangles.size() > 1 ? a.sphere.radius : 0) < (b.triangles.size() > 1 ? b.sphere.radius : 0);
    });
    if (widest->triangles.size() < 2) break;
    auto [first, second] = halves(scene.geometry, std::move(widest->triangles));
    *widest = std::move(first);
    pieces.push_back(std::move(second));
    const double shadow = mean_shadow(spheres_of(pieces));
    // One more sphere costs a little, so it must gain more than the estimate's error.
    if (shadow < 0.97 * best_shadow) {
      best = spheres_of(pieces);
      best_shadow = shadow;
    }
  }
  return best;
}

} // namespace nephroid::tracing
