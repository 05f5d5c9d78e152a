// SPDX-License-Identifier: Apache-2.0
#include "scene/move.h"

#include "scene/corners.h"
#include "scene/place.h"
#include "scene/rotation.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace nephroid::scene {
namespace {

/// In the scene's coordinates.
struct Motion {
  glm::dmat3 turn{1};
  glm::dvec3 shift{0};

  glm::vec3 operator()(const glm::vec3& p) const { return turn * glm::dvec3(p) + shift; }
};

Motion motion(const preset::Transform& before, const preset::Transform& now, const glm::dvec3& origin)
{
  const auto vector = [](const preset::Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dmat3 turn = rotation(now.rotate_deg) * glm::transpose(rotation(before.rotate_deg));
  return {turn, turn * (origin - vector(before.translate)) + vector(now.translate) - origin};
}

/// The vertices that an object's triangles use follow each other and are its own (scene.cpp).
void move_vertices(Scene& scene, const Object& object, const Motion& move)
{
  std::uint32_t first = ~0U, end = 0;
  for_each_corner_index(scene, object, [&](std::uint32_t vertex) {
    first = std::min(first, vertex);
    end = std::max(end, vertex + 1);
  });
  for (std::uint32_t v = first; v < end; ++v) {
    scene.geometry.positions[v] = move(scene.geometry.positions[v]);
    scene.geometry.normals[v] = glm::normalize(move.turn * glm::dvec3(scene.geometry.normals[v]));
  }
}

/// A turn moves nothing of a sphere.
void move_ellipsoids(Scene& scene, const Object& object, const Motion& move)
{
  for (Ellipsoid& ellipsoid : std::span(scene.geometry.ellipsoids).subspan(object.first_ellipsoid, object.ellipsoid_count)) {
    ellipsoid.centre = move(ellipsoid.centre);
    const double longest = longest_half_axis(ellipsoid);
    if (longest - shortest_half_axis(ellipsoid) > 0x1p-20 * longest)
      for (glm::vec3& axis : ellipsoid.half_axes) axis = move.turn * glm::dvec3(axis);
  }
}

double reach(const Scene& scene)
{
  double farthest = 0;
  for (const Object& object : scene.objects)
    farthest = std::max<double>(farthest, glm::length(object.bounds.centre) + object.bounds.radius);
  return farthest;
}

} // namespace

std::optional<Scene> move_objects(const Scene& loaded, const preset::Preset& before, const preset::Preset& now)
{
  Scene scene = loaded;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const preset::Transform &from = before.scene.objects[i].transform, &to = now.scene.objects[i].transform;
    if (from == to) continue;
    Object& object = scene.objects[i];
    const Motion move = motion(from, to, scene.origin);
    move_vertices(scene, object, move);
    move_ellipsoids(scene, object, move);
    object.bounds = enclosing_sphere(scene.geometry, triangles_of(scene, object), ellipsoids_of(scene, object));
  }
  if (!(reach(scene) <= 2 * reach(loaded))) return {};
  part_touching(scene);
  scene.warnings = loaded.warnings;
  scene.camera = make_camera(now.scene.camera, scene);
  return scene;
}

} // namespace nephroid::scene
