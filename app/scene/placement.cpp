// SPDX-License-Identifier: Apache-2.0
#include "scene/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

namespace nephroid::scene {
namespace {

/// The square of the distance from a point to a triangle (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
double distance2(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto to_edge = [&](const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 edge = to - from, way = p - from;
    const double along = std::clamp(glm::dot(way, edge) / glm::dot(edge, edge), 0.0, 1.0);
    return glm::dot(way - along * edge, way - along * edge);
  };
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  bool is_above = true;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    is_above = is_above && glm::dot(glm::cross(to - from, p - from), normal) >= 0;
  if (!is_above) return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const double height = glm::dot(p - a, normal);
  return height * height / glm::dot(normal, normal);
}

bool holds(const Scene& scene, const Object& object, const glm::dvec3& p) {
  for (const Ellipsoid& ellipsoid : ellipsoids_of(scene, object))
    if (contains(ellipsoid, p)) return true;
  if (!(winding_number(scene.geometry, object.first_triangle, object.triangle_count, p) > 0.5)) return false;
  Mesh alone; // of what lets no light through nobody knows yet whether it is closed
  for (const glm::uvec3& t : triangles_of(scene, object)) alone.triangles.push_back(t - object.first_vertex);
  for (const glm::vec3& vertex : vertices_of(scene, object)) alone.positions.push_back(vertex);
  return inspect(alone).closed();
}

bool is_in_surface(const Scene& scene, const Object& object, const glm::dvec3& p, double tolerance) {
  return std::ranges::any_of(triangles_of(scene, object), [&](const glm::uvec3& t) {
    const auto at = [&](int corner) { return glm::dvec3(scene.geometry.positions[t[corner]]); };
    return distance2(p, at(0), at(1), at(2)) <= tolerance * tolerance;
  });
}

} // namespace

std::set<std::pair<std::size_t, std::size_t>> copies(const preset::Scene& scene) {
  using Place = std::tuple<std::string, preset::Vec3, preset::Vec3, preset::Vec3>;
  std::map<Place, std::vector<std::size_t>> there;
  std::set<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const preset::Object& object = scene.objects[i];
    const auto& [scale, rotate, translate] =
        std::tie(object.transform.scale, object.transform.rotate_deg, object.transform.translate);
    std::vector<std::size_t>& others = there[{object.mesh.value_or(""), scale, rotate, translate}];
    const auto same = std::ranges::find_if(others, [&](std::size_t other) {
      return scene.objects[other].shape == object.shape && scene.objects[other].states == object.states;
    });
    if (same != others.end())
      found.emplace(*same, i);
    else
      others.push_back(i);
  }
  return found;
}

void warn_of_hidden_lamps(Scene& scene) {
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.type != preset::Light::Type::point && light.type != preset::Light::Type::spot) continue;
    const glm::dvec3 p(light.position);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object& object = scene.objects[i];
      const double reach = object.bounds.radius + glm::length(object.bounds.centre), tolerance = 1e-6 * reach;
      if (glm::distance(p, glm::dvec3(object.bounds.centre)) > object.bounds.radius + tolerance) continue;
      const bool in_surface = is_in_surface(scene, object, p, tolerance);
      const bool is_opaque = !is_refractive(material_of(scene, object).type);
      if (!in_surface && !(is_opaque && holds(scene, object, p) && !holds(scene, object, scene.camera.position)))
        continue;
      const std::string name =
          object.name.empty() ? fmt::format("object {}", i) : fmt::format("object '{}'", object.name);
      scene.warnings.push_back(in_surface
                                   ? fmt::format("scene.lights.{} lies in the surface of {}; move it out", l, name)
                                   : fmt::format("scene.lights.{} is inside of {}, which lets no light out", l, name));
    }
  }
}

} // namespace nephroid::scene
