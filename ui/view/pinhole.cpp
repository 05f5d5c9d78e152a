// SPDX-License-Identifier: Apache-2.0
#include "ui/view/pinhole.h"

#include "preset/read.h"
#include "scene/bvh.h"
#include "scene/ray.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::ui {
namespace {

bool is_same_surface(const preset::Object& a, const preset::Object& b) {
  return a.mesh == b.mesh && a.shape == b.shape;
}

/// The box about all vertices, in the object's own coordinates.
scene::Bounds box_of(const scene::Scene& scene, const scene::Object& object, const preset::Transform& transform) {
  const Affine placed(transform);
  const glm::dmat3 back = glm::inverse(placed.linear);
  const glm::dvec3 shift = scene.origin - placed.offset;
  scene::Bounds box;
  const auto add = [&](const glm::dvec3& p) { box = scene::enclosing(box, {p, p}); };
  for (const glm::vec3& p : scene::vertices_of(scene, object)) add(back * (glm::dvec3(p) + shift));
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
  return box;
}

/// Moves the ray to the place that an object had when the scene was loaded, in the scene's coordinates. A hit is
/// equally far along both rays, in lengths of their directions.
Ray moved_back(const Ray& ray, const preset::Transform& now, const preset::Transform& loaded,
               const glm::dvec3& origin) {
  if (now == loaded) return {ray.origin - origin, ray.direction};
  const Affine from(now), to(loaded);
  const glm::dmat3 linear = to.linear * glm::inverse(from.linear);
  return {linear * (ray.origin - from.offset) + to.offset - origin, linear * ray.direction};
}

/// The camera's directions; right is defined even where it looks along up.
struct Axes {
  glm::dvec3 up, right, outwards; ///< unit vectors; outwards: from the target to the camera
  double distance = 1;
};

Axes axes(const preset::Camera& camera) {
  Axes a;
  const glm::dvec3 arm = to_vector(camera.position) - to_vector(camera.target);
  a.distance = glm::length(arm);
  a.outwards = a.distance > 0 ? arm / a.distance : glm::dvec3(0, 0, 1);
  const glm::dvec3 up = to_vector(camera.up);
  a.up = glm::length(up) > 0 ? glm::normalize(up) : glm::dvec3(0, 1, 0);
  glm::dvec3 right = glm::cross(a.up, a.outwards);
  if (glm::length(right) < 1e-9)
    right = glm::cross(a.up, std::abs(a.up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
  a.right = glm::normalize(right);
  return a;
}

preset::Json camera_fields(const preset::Preset& preset) { return preset::as_json(preset).at("scene").at("camera"); }

} // namespace

Affine::Affine(const preset::Transform& transform)
    : linear(scene::rotation(transform.rotate_deg)), offset(to_vector(transform.translate)) {
  for (int i = 0; i < 3; ++i) linear[i] *= transform.scale[static_cast<std::size_t>(i)];
}

std::optional<Point> Pinhole::to_screen(const glm::dvec3& p) const {
  const glm::dvec3 arm = p - position;
  const double ahead = glm::dot(arm, forward);
  if (!(ahead > 0)) return std::nullopt;
  const double far = orthographic ? 1 : ahead, x = glm::dot(arm, right) / (far * tan_x) - shift_x,
               y = glm::dot(arm, up) / (far * tan_y) - shift_y;
  return Point{corner[0] + size[0] * (x + 1) / 2, corner[1] + size[1] * (1 - y) / 2};
}

Ray Pinhole::ray(const Point& screen) const {
  const double x = 2 * (screen[0] - corner[0]) / size[0] - 1 + shift_x,
               y = 1 - 2 * (screen[1] - corner[1]) / size[1] + shift_y;
  const glm::dvec3 aside = x * tan_x * right + y * tan_y * up;
  if (orthographic) return {position + aside, forward};
  return {position, forward + aside};
}

std::optional<Pinhole> make_pinhole(const preset::Camera& camera, const Placement& placement,
                                    const std::array<int, 2>& shown) {
  Pinhole pinhole;
  pinhole.position = to_vector(camera.position);
  const glm::dvec3 arm = to_vector(camera.target) - pinhole.position;
  const double distance = glm::length(arm);
  if (!(distance > 0 && std::isfinite(distance))) return std::nullopt;
  pinhole.forward = arm / distance;
  const glm::dvec3 right = glm::cross(pinhole.forward, to_vector(camera.up));
  const double across = glm::length(right);
  if (!(across > 1e-6 * glm::length(to_vector(camera.up)))) return std::nullopt;
  pinhole.right = right / across;
  pinhole.up = glm::cross(pinhole.right, pinhole.forward);
  pinhole.orthographic = camera.projection == preset::Camera::Projection::orthographic;
  pinhole.tan_y =
      pinhole.orthographic ? preset::height_at_target(camera) / 2 : std::tan(glm::radians(camera.fov_deg) / 2);
  pinhole.shift_x = 2 * camera.shift[0];
  pinhole.shift_y = 2 * camera.shift[1];
  pinhole.tan_x = pinhole.tan_y * camera.resolution[0] / camera.resolution[1];
  pinhole.corner = placement.origin;
  for (std::size_t i = 0; i < 2; ++i) pinhole.size[i] = placement.scale * shown[i];
  return pinhole;
}

void ViewedScene::take(const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded,
                       SceneFacts& facts) {
  auto seen = std::make_shared<ViewedScene>();
  seen->loaded = loaded;
  const scene::Scene& scene = loaded->scene;
  if (scene.objects.size() == preset.scene.objects.size()) seen->objects = preset.scene.objects;
  for (std::size_t i = 0; i < seen->objects.size(); ++i)
    seen->boxes.push_back(box_of(scene, scene.objects[i], seen->objects[i].transform));
  facts.view = std::move(seen);
}

std::optional<std::size_t> object_at(const ViewedScene& seen, const preset::Preset& preset, const Ray& ray) {
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
      trace(moved_back(ray, now[i].transform, seen.objects[i].transform, scene.origin),
            [&](std::size_t other) { return other == i; });
  return nearest;
}

std::optional<scene::Bounds> local_box(const ViewedScene* seen, const preset::Preset& preset, std::size_t object) {
  const std::vector<preset::Object>& now = preset.scene.objects;
  if (!seen || object >= seen->objects.size() || object >= now.size() ||
      !is_same_surface(now[object], seen->objects[object]))
    return std::nullopt;
  return seen->boxes[object];
}

glm::dvec3 pivot_of(const ViewedScene* seen, const preset::Preset& preset, std::size_t object) {
  const auto box = local_box(seen, preset, object);
  if (!box || preset.scene.objects[object].shape) return glm::dvec3(0);
  return 0.5 * box->low + 0.5 * box->high;
}

preset::Camera orbit(const preset::Camera& camera, double right_deg, double up_deg) {
  const Axes a = axes(camera);
  // Spherical coordinates about up: the polar angle and, in the plane perpendicular to it, `ahead` (the camera's side)
  // and `right`.
  const glm::dvec3 ahead = glm::cross(a.right, a.up);
  const double polar = std::acos(std::clamp(glm::dot(a.outwards, a.up), -1.0, 1.0));
  const double limit = glm::radians(1.0);
  const double new_polar = std::clamp(polar - glm::radians(up_deg), limit, glm::pi<double>() - limit);
  const double azimuth = glm::radians(right_deg);
  const glm::dvec3 across = std::cos(azimuth) * ahead + std::sin(azimuth) * a.right;
  preset::Camera moved = camera;
  moved.position =
      to_stored(to_vector(camera.target) + a.distance * (std::cos(new_polar) * a.up + std::sin(new_polar) * across));
  return moved;
}

preset::Camera dolly(const preset::Camera& camera, double factor) {
  preset::Camera moved = camera;
  const glm::dvec3 target = to_vector(camera.target);
  moved.position = to_stored(target + factor * (to_vector(camera.position) - target));
  if (moved.height) *moved.height *= factor;
  return moved;
}

preset::Camera pan(const preset::Camera& camera, double right, double down) {
  const Axes a = axes(camera);
  const glm::dvec3 picture_up = glm::cross(a.outwards, a.right);
  const double height = preset::height_at_target(camera);
  const glm::dvec3 shift = height * (down * picture_up - right * a.right);
  preset::Camera moved = camera;
  moved.position = to_stored(to_vector(camera.position) + shift);
  moved.target = to_stored(to_vector(camera.target) + shift);
  return moved;
}

std::string camera_json(const preset::Preset& preset) {
  return preset::Json{{"camera", camera_fields(preset)}}.dump(2) + "\n";
}

std::string camera_settings(const preset::Preset& preset) {
  std::string text;
  for (const preset::Json fields = camera_fields(preset); const auto& [name, value] : fields.items())
    text += fmt::format("{}--set 'scene.camera.{}={}'", text.empty() ? "" : " ", name, value.dump());
  return text;
}

} // namespace nephroid::ui
