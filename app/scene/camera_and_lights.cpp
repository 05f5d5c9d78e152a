// SPDX-License-Identifier: Apache-2.0
// Vectors are checked, in double, then rounded once.
#include "scene/scene.h"

#include "base/error.h"
#include "scene/materials.h"
#include "scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::scene {
namespace {

/// The unit vector along v. Throws bad_input at where: no length, not finite.
glm::dvec3 unit_direction(const glm::dvec3& v, const Location& where) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!finite || largest == 0)
    throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) has no direction", v.x, v.y, v.z), "a vector with a length");
  return glm::normalize(v / largest); // so that no square overflows or vanishes
}

/// The part of up that is perpendicular to the unit vector forward, made unit. Throws bad_input at where: parallel, no
/// length.
glm::dvec3 perpendicular_up(const preset::Vec3& up, const glm::dvec3& forward, const Location& where) {
  const glm::dvec3 unit_up = unit_direction(to_dvec3(up), where);
  const glm::dvec3 rest = unit_up - glm::dot(unit_up, forward) * forward;
  if (!(glm::length(rest) > 1e-6))
    throw bad_input(where,
                    fmt::format("({:g}, {:g}, {:g}) is parallel to the view or light direction", up[0], up[1], up[2]),
                    "another direction", "turn it away");
  return glm::normalize(rest);
}

/// A preset's position in the scene's coordinates. Throws bad_input at where: not finite, too far from the objects.
glm::dvec3 local_position(const preset::Vec3& position, const Scene& scene, const Location& where) {
  const glm::dvec3 local = to_dvec3(position) - scene.origin;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(local[axis]) <= max_coordinate))
      throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) is too far away", position[0], position[1], position[2]),
                      fmt::format("at most {:g} units from the refracting and mirroring objects", max_coordinate),
                      "choose a larger unit");
  return local;
}

/// What is not seen from one point may not begin in glass: which rays do would not be known. Throws bad_input there.
void refuse_glass_about(const Camera& camera, const Scene& scene, const Location& where) {
  const glm::dvec3 eye = camera.position;
  const double across = camera.lens_radius + (camera.orthographic ? camera.tan_x : 0),
               upwards = camera.lens_radius + (camera.orthographic ? camera.tan_y : 0);
  for (const Object& object : scene.objects) {
    if (!is_refractive(material_of(scene, object).type) || is_empty(object)) continue;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for_each_corner(scene, object, [&](const glm::dvec3& p) {
      const glm::dvec3 way = p - eye;
      const glm::dvec3 seen(glm::dot(way, glm::dvec3(camera.right)), glm::dot(way, glm::dvec3(camera.up)),
                            glm::dot(way, glm::dvec3(camera.forward)));
      low = glm::min(low, seen);
      high = glm::max(high, seen);
    });
    if (low.z <= 0 && high.z >= 0 && low.x <= across && high.x >= -across && low.y <= upwards && high.y >= -upwards)
      throw bad_input(where / (camera.orthographic ? "projection" : "aperture"),
                      fmt::format("the camera's {} may touch the glass of object '{}'",
                                  camera.orthographic ? "picture plane" : "lens", object.name),
                      "expected one in front of all glass", "move the camera away from the target");
  }
}

} // namespace

Camera make_camera(const preset::Camera& camera, const Scene& scene) {
  const Location where = Location(scene.source) / "scene" / "camera";
  const auto [width, height] = camera.resolution;
  Camera result;
  const glm::dvec3 position = local_position(camera.position, scene, where / "position");
  const glm::dvec3 target = to_dvec3(camera.target) - scene.origin;
  const glm::dvec3 forward = unit_direction(target - position, where / "target");
  const glm::dvec3 up = perpendicular_up(camera.up, forward, where / "up");
  result.position = position;
  result.forward = forward;
  result.up = up;
  result.right = glm::cross(forward, up);
  result.tan_y = std::tan(camera.fov_deg / 2 * std::numbers::pi / 180);
  result.tan_x = result.tan_y * width / height;
  result.width = width;
  result.height = height;
  result.orthographic = camera.projection == preset::Camera::Projection::orthographic;
  if (result.orthographic) {
    result.tan_y = preset::height_at_target(camera) / 2;
    result.tan_x = result.tan_y * width / height;
  }
  const glm::dvec2 shift(2 * camera.shift[0] * result.tan_x, 2 * camera.shift[1] * result.tan_y);
  if (result.orthographic)
    result.position = position + shift.x * glm::dvec3(result.right) + shift.y * up;
  else
    result.shift = shift;
  result.lens_radius = camera.aperture / 2;
  result.focus = camera.focus_distance.value_or(preset::target_distance(camera));
  if (result.orthographic || result.lens_radius > 0)
    refuse_glass_about(result, scene, where);
  else
    result.inside = dielectrics_around(scene, position);
  return result;
}

Light make_light(const preset::Light& light, const Scene& scene, const Location& where) {
  using Type = preset::Light::Type;
  Light result;
  result.type = light.type;
  result.spectrum = make_light_spectrum(light.spectrum, where / "spectrum");
  if (light.type != Type::point) {
    const glm::dvec3 direction = unit_direction(to_dvec3(light.direction), where / "direction");
    result.direction = direction;
    if (light.type == Type::area) {
      const glm::dvec3 up = perpendicular_up(light.up, direction, where / "up");
      result.edge_u = light.size[0] * glm::cross(up, direction);
      result.edge_v = light.size[1] * up;
    }
  }
  if (light.type == Type::spot) result.cos_half_angle = std::cos(light.half_angle_deg * std::numbers::pi / 180);
  if (light.type == Type::directional) {
    result.irradiance_w_m2 = light.irradiance_w_m2;
    result.one_minus_cos = 2 * std::pow(std::sin(light.angular_diameter_deg / 4 * std::numbers::pi / 180), 2);
    return result; // comes from far away: inside nothing
  }
  result.power_w = light.power_w;
  const glm::dvec3 position = local_position(light.position, scene, where / "position");
  result.position = position;
  result.inside = dielectrics_around(scene, position);
  return result;
}

} // namespace nephroid::scene
