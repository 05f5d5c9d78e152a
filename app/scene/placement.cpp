// SPDX-License-Identifier: Apache-2.0
#include "scene/placement.h"

#include "scene/ray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

namespace nephroid::scene {
namespace {

/// Whether a place is inside of a larger mesh takes too long for a note.
constexpr std::uint32_t most_looked_through = 200'000;

std::string name_of(const Scene& scene, std::size_t object) {
  const std::string& name = scene.objects[object].name;
  return name.empty() ? fmt::format("object {}", object) : fmt::format("object '{}'", name);
}

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
    const glm::dvec3 a = at(0), b = at(1), c = at(2), low = glm::min(a, glm::min(b, c)) - tolerance,
                     high = glm::max(a, glm::max(b, c)) + tolerance;
    if (glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high))) return false;
    return distance2(p, a, b, c) <= tolerance * tolerance;
  });
}

} // namespace

std::vector<std::size_t> first_copies(const preset::Scene& scene) {
  using Place = std::tuple<std::string, preset::Vec3, preset::Vec3, preset::Vec3>;
  std::map<Place, std::vector<std::size_t>> there;
  std::vector<std::size_t> first(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const preset::Object& object = scene.objects[i];
    const preset::Transform& at = object.transform;
    std::vector<std::size_t>& others = there[{object.mesh.value_or(""), at.scale, at.rotate_deg, at.translate}];
    const auto same = std::ranges::find_if(others, [&](std::size_t other) {
      return scene.objects[other].shape == object.shape && scene.objects[other].states == object.states;
    });
    first[i] = same != others.end() ? *same : i;
    if (same == others.end()) others.push_back(i);
  }
  return first;
}

std::vector<std::string> hidden_lamps(const Scene& scene) {
  std::vector<std::string> lines;
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.type != preset::Light::Type::point && light.type != preset::Light::Type::spot) continue;
    const glm::dvec3 p(light.position);
    const double tolerance = 1e-6 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object& object = scene.objects[i];
      if (glm::distance(p, glm::dvec3(object.bounds.centre)) > object.bounds.radius + tolerance) continue;
      const std::string name = name_of(scene, i);
      if (is_in_surface(scene, object, p, tolerance))
        lines.push_back(fmt::format("scene.lights.{} lies in the surface of {}; move it out", l, name));
      else if (!is_refractive(material_of(scene, object).type) && object.triangle_count <= most_looked_through &&
               holds(scene, object, p) && !holds(scene, object, scene.camera.position))
        lines.push_back(fmt::format("scene.lights.{} is inside of {}, which lets no light out", l, name));
    }
  }
  return lines;
}

std::optional<std::string> covered(const MeterSurface& meter, const Scene& scene, const Bvh& bvh) {
  if (meter.object >= 0 || meter.is_goniometer()) return {};
  const CountsPrimitive is_opaque = [&](std::uint32_t primitive) {
    return !is_refractive(material_of(scene, scene.objects[scene.object_of_primitive[primitive]]).type);
  };
  const std::size_t probes = std::min<std::size_t>(meter.count(), 64);
  std::map<std::uint32_t, std::size_t> count_of; // [object]
  for (std::size_t probe = 0; probe < probes; ++probe) {
    const std::size_t cell = probe * meter.count() / probes;
    const double reach = std::sqrt(meter.areas[cell]);
    const auto hit = closest_hit(bvh, meter.centres[cell], meter.normals[cell], is_opaque, reach);
    if (hit) ++count_of[scene.object_of_primitive[hit->primitive]];
  }
  for (const auto& [object, count] : count_of)
    if (2 * count > probes)
      return fmt::format("the meter '{}' looks at {} from close by, which covers it: move it to the other side, or "
                         "turn its normal",
                         meter.name, name_of(scene, object));
  return {};
}

} // namespace nephroid::scene
