// SPDX-License-Identifier: Apache-2.0
// Objects of a loaded scene that move: glass away from what it stands exactly on, and all to where another preset has
// them.
#include "scene/move.h"

#include "scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::scene {
namespace {

/// Shares of the largest coordinate of the two objects. Rays start 2^-21 of a triangle's coordinates off it
/// (kernels/tracing/surface.h), so this is several times what either side's rays step over.
constexpr double gap_share = 0x1p-18, touching_share = 0x1p-21;

/// The axis along which a face of `glass` lies in a face of the other's bounds, while they overlap along the other two;
/// -1: none.
int touching_axis(const Bounds& glass, const Bounds& other, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    bool meets = true;
    for (int j = 0; j < 3; ++j)
      if (j != k) meets = meets && glass.low[j] < other.high[j] + tolerance && other.low[j] < glass.high[j] + tolerance;
    if (!meets) continue;
    for (const double face : {glass.low[k], glass.high[k]})
      for (const double other_face : {other.low[k], other.high[k]})
        if (std::abs(face - other_face) <= tolerance) return k;
  }
  return -1;
}

/// An ellipsoid meets what it touches in one point, where nothing is lost; only two of them can lie in one place.
bool can_coincide(const Object& a, const Bounds& at_a, const Object& b, const Bounds& at_b, double tolerance) {
  if (a.ellipsoid_count + b.ellipsoid_count == 0) return true;
  bool same = a.ellipsoid_count == b.ellipsoid_count;
  for (int k = 0; k < 3; ++k)
    same =
        same && std::abs(at_a.low[k] - at_b.low[k]) <= tolerance && std::abs(at_a.high[k] - at_b.high[k]) <= tolerance;
  return same;
}

/// Leaves a gap between the glass and what it touches across the axis: moves every face of it that lies across inwards,
/// or, where it is too thin for that, all of it away from the other's face.
void part(Scene& scene, const Object& glass, const Bounds& bounds, const Bounds& other, int axis, double gap) {
  const double middle = 0.5 * (bounds.low[axis] + bounds.high[axis]),
               half = 0.5 * (bounds.high[axis] - bounds.low[axis]);
  const auto distance_of = [&](double face) {
    return std::min(std::abs(face - other.low[axis]), std::abs(face - other.high[axis]));
  };
  for (Ellipsoid& ellipsoid :
       std::span(scene.geometry.ellipsoids).subspan(glass.first_ellipsoid, glass.ellipsoid_count))
    for (glm::vec3& half_axis : ellipsoid.half_axes) half_axis *= static_cast<float>(1 - std::min(gap / half, 0.125));
  if (glass.triangle_count == 0) return;
  const double away = distance_of(bounds.low[axis]) < distance_of(bounds.high[axis]) ? gap : -gap;
  for (glm::vec3& p : std::span(scene.geometry.positions).subspan(glass.first_vertex, glass.vertex_count)) {
    const double at = p[axis];
    p[axis] = static_cast<float>(half >= 8 * gap ? middle + (at - middle) * (1 - gap / half) : at + away);
  }
}

std::string label(const Scene& scene, std::size_t object) {
  return scene.objects[object].name.empty() ? fmt::format("object {}", object)
                                            : fmt::format("object '{}'", scene.objects[object].name);
}

/// Moved away from one thing onto another: there is no room for it.
void warn_if_between(Scene& scene, const std::vector<Bounds>& bounds, std::size_t i) {
  for (std::size_t j = 0; j < scene.objects.size(); ++j)
    if (i != j && scene.objects[i].ellipsoid_count + scene.objects[j].ellipsoid_count == 0 &&
        touching_axis(bounds[i], bounds[j], touching_share * largest_coordinate(enclosing(bounds[i], bounds[j]))) >= 0)
      scene.warnings.push_back(
          fmt::format("{} lies exactly on {} and is too thin to be parted from it: light may be lost between them; "
                      "move it, make it thicker, or let them overlap",
                      label(scene, i), label(scene, j)));
}

/// In the scene's coordinates.
struct Motion {
  glm::dmat3 turn{1};
  glm::dvec3 shift{0};

  glm::vec3 operator()(const glm::vec3& p) const { return turn * glm::dvec3(p) + shift; }
};

Motion motion(const preset::Transform& before, const preset::Transform& now, const glm::dvec3& origin) {
  const glm::dmat3 turn = rotation(now.rotate_deg) * glm::transpose(rotation(before.rotate_deg));
  return {turn, turn * (origin - to_dvec3(before.translate)) + to_dvec3(now.translate) - origin};
}

/// A turn moves nothing of a sphere.
void move_ellipsoids(Scene& scene, const Object& object, const Motion& move) {
  for (Ellipsoid& ellipsoid :
       std::span(scene.geometry.ellipsoids).subspan(object.first_ellipsoid, object.ellipsoid_count)) {
    ellipsoid.centre = move(ellipsoid.centre);
    const double longest = longest_half_axis(ellipsoid);
    if (longest - shortest_half_axis(ellipsoid) > 0x1p-20 * longest)
      for (glm::vec3& axis : ellipsoid.half_axes) axis = move.turn * glm::dvec3(axis);
  }
}

} // namespace

void part_touching(Scene& scene, const std::vector<std::size_t>& first_copies) {
  std::vector<Bounds> bounds;
  for (const Object& object : scene.objects) bounds.push_back(bounds_of(scene, object));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!is_body(material_of(scene, scene.objects[i]))) continue;
    for (std::size_t j = 0; j < scene.objects.size(); ++j) {
      if (i == j) continue;
      const double largest = largest_coordinate(enclosing(bounds[i], bounds[j])), tolerance = touching_share * largest;
      const int axis = touching_axis(bounds[i], bounds[j], tolerance);
      if (axis < 0 || !can_coincide(scene.objects[i], bounds[i], scene.objects[j], bounds[j], tolerance)) continue;
      part(scene, scene.objects[i], bounds[i], bounds[j], axis, gap_share * largest);
      bounds[i] = bounds_of(scene, scene.objects[i]);
      if (!first_copies.empty() && first_copies[i] == first_copies[j]) continue;
      scene.warnings.push_back(
          fmt::format("{} touches {}: a gap of {:.2g} length units is left between them; let them overlap to have none",
                      label(scene, i), label(scene, j), gap_share * largest));
    }
    warn_if_between(scene, bounds, i);
  }
}

std::optional<Scene> move_objects(const Scene& loaded, const preset::Preset& before, const preset::Preset& now) {
  Scene scene = loaded;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const preset::Transform &from = before.scene.objects[i].transform, &to = now.scene.objects[i].transform;
    if (from == to) continue;
    Object& object = scene.objects[i];
    const Motion move = motion(from, to, scene.origin);
    for (std::size_t v = object.first_vertex; v < std::size_t{object.first_vertex} + object.vertex_count; ++v) {
      scene.geometry.positions[v] = move(scene.geometry.positions[v]);
      scene.geometry.normals[v] = glm::normalize(move.turn * glm::dvec3(scene.geometry.normals[v]));
    }
    move_ellipsoids(scene, object, move);
    object.bounds = enclosing_sphere(scene.geometry, triangles_of(scene, object), ellipsoids_of(scene, object));
  }
  if (!(scene_radius(scene) <= 2 * scene_radius(loaded))) return {};
  part_touching(scene);
  scene.warnings = loaded.warnings;
  scene.camera = make_camera(now.scene.camera, scene);
  return scene;
}

} // namespace nephroid::scene
