// SPDX-License-Identifier: Apache-2.0
#include "ui/view/sight.h"

#include "scene/bvh.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::ui {
namespace {

/// p -> linear p + offset, from an object's own coordinates to the preset's.
struct Affine {
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};
};

Affine affine(const preset::Transform& transform)
{
  glm::dmat3 scale(1);
  for (int i = 0; i < 3; ++i) scale[i][i] = transform.scale[static_cast<std::size_t>(i)];
  return {scene::rotation(transform.rotate_deg) * scale, to_vector(transform.translate)};
}

bool is_same_surface(const preset::Object& a, const preset::Object& b) { return a.mesh == b.mesh && a.shape == b.shape; }

/// About every corner, in the object's own coordinates.
scene::Bounds box_of(const scene::Scene& scene, const scene::Object& object, const preset::Transform& transform)
{
  const Affine placed = affine(transform);
  const glm::dmat3 back = glm::inverse(placed.linear);
  const glm::dvec3 shift = scene.origin - placed.offset;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  const auto add = [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  };
  scene::for_each_corner_index(scene, object,
                               [&](std::uint32_t vertex) { add(back * (glm::dvec3(scene.geometry.positions[vertex]) + shift)); });
  for (const scene::Ellipsoid& ellipsoid : scene::ellipsoids_of(scene, object)) {
    const glm::dvec3 centre = back * (glm::dvec3(ellipsoid.centre) + shift);
    glm::dvec3 squares(0);
    for (const glm::vec3& axis : ellipsoid.half_axes) {
      const glm::dvec3 own = back * glm::dvec3(axis);
      squares += own * own;
    }
    add(centre - glm::sqrt(squares));
    add(centre + glm::sqrt(squares));
  }
  return {low, high};
}

/// The ray in the place that an object had when the scene was loaded, in the scene's coordinates. A hit is as far along it, in lengths of
/// the direction, as along the ray itself.
Ray moved_back(const Ray& ray, const preset::Transform& now, const preset::Transform& loaded, const glm::dvec3& origin)
{
  if (now == loaded) return {ray.origin - origin, ray.direction};
  const Affine from = affine(now), to = affine(loaded);
  const glm::dmat3 linear = to.linear * glm::inverse(from.linear);
  return {linear * (ray.origin - from.offset) + to.offset - origin, linear * ray.direction};
}

} // namespace

std::optional<Point> Sight::to_screen(const glm::dvec3& p) const
{
  const glm::dvec3 arm = p - position;
  const double ahead = glm::dot(arm, forward);
  if (!(ahead > 0)) return std::nullopt;
  const double x = glm::dot(arm, right) / (ahead * tan_x), y = glm::dot(arm, up) / (ahead * tan_y);
  return Point{corner[0] + size[0] * (x + 1) / 2, corner[1] + size[1] * (1 - y) / 2};
}

Ray Sight::ray(const Point& screen) const
{
  const double x = 2 * (screen[0] - corner[0]) / size[0] - 1, y = 1 - 2 * (screen[1] - corner[1]) / size[1];
  return {position, forward + x * tan_x * right + y * tan_y * up};
}

std::optional<Sight> make_sight(const preset::Camera& camera, const Placement& placement, const std::array<int, 2>& shown)
{
  Sight sight;
  sight.position = to_vector(camera.position);
  const glm::dvec3 arm = to_vector(camera.target) - sight.position;
  const double distance = glm::length(arm);
  if (!(distance > 0 && std::isfinite(distance))) return std::nullopt;
  sight.forward = arm / distance;
  const glm::dvec3 right = glm::cross(sight.forward, to_vector(camera.up));
  const double across = glm::length(right);
  if (!(across > 1e-6 * glm::length(to_vector(camera.up)))) return std::nullopt;
  sight.right = right / across;
  sight.up = glm::cross(sight.right, sight.forward);
  sight.tan_y = std::tan(glm::radians(camera.fov_deg) / 2);
  sight.tan_x = sight.tan_y * camera.resolution[0] / camera.resolution[1];
  sight.corner = placement.origin;
  for (std::size_t i = 0; i < 2; ++i) sight.size[i] = placement.scale * shown[i];
  return sight;
}

std::any SeenScene::look(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded)
{
  auto seen = std::make_shared<SeenScene>();
  seen->loaded = loaded;
  const scene::Scene& scene = loaded->scene;
  if (scene.objects.size() == preset.scene.objects.size()) seen->objects = preset.scene.objects;
  for (std::size_t i = 0; i < seen->objects.size(); ++i) seen->boxes.push_back(box_of(scene, scene.objects[i], seen->objects[i].transform));
  return std::shared_ptr<const SeenScene>(std::move(seen));
}

std::optional<std::size_t> object_at(const SeenScene& seen, const preset::Preset& preset, const Ray& ray)
{
  const scene::Scene& scene = seen.loaded->scene;
  const std::vector<preset::Object>& now = preset.scene.objects;
  std::optional<std::size_t> nearest;
  double distance = std::numeric_limits<double>::infinity();
  const auto trace = [&](const Ray& local, const auto& counts) {
    const auto hit = scene::closest_hit(
        *seen.loaded->bvh, local.origin, local.direction,
        [&](std::uint32_t primitive) { return counts(scene.object_of_primitive[primitive]); }, distance);
    if (!hit) return;
    nearest = scene.object_of_primitive[hit->primitive];
    distance = hit->t;
  };
  const auto is_found = [&](std::size_t i) { return i < now.size() && is_same_surface(now[i], seen.objects[i]); };
  const auto stayed = [&](std::size_t i) { return is_found(i) && now[i].transform == seen.objects[i].transform; };
  trace({ray.origin - scene.origin, ray.direction}, stayed);
  for (std::size_t i = 0; i < seen.objects.size(); ++i)
    if (is_found(i) && !stayed(i))
      trace(moved_back(ray, now[i].transform, seen.objects[i].transform, scene.origin), [&](std::size_t other) { return other == i; });
  return nearest;
}

std::optional<scene::Bounds> local_box(const SeenScene* seen, const preset::Preset& preset, std::size_t object)
{
  const std::vector<preset::Object>& now = preset.scene.objects;
  if (!seen || object >= seen->objects.size() || object >= now.size() || !is_same_surface(now[object], seen->objects[object]))
    return std::nullopt;
  return seen->boxes[object];
}

glm::dvec3 pivot_of(const SeenScene* seen, const preset::Preset& preset, std::size_t object)
{
  const auto box = local_box(seen, preset, object);
  if (!box || preset.scene.objects[object].shape) return glm::dvec3(0);
  return 0.5 * box->low + 0.5 * box->high;
}

} // namespace nephroid::ui
