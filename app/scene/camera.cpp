// SPDX-License-Identifier: Apache-2.0
// Vectors are checked, in double, then rounded once.
#include "scene/scene.h"

#include "base/error.h"
#include "scene/directions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::scene {

namespace {

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

} // namespace nephroid::scene
