// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/directions.h"
#include "scene/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace nephroid::scene {

Camera make_camera(const preset::Camera& camera, const Scene& scene)
{
  const Place where = Place(scene.source) / "scene" / "camera";
  if (!(camera.fov_deg > 0 && camera.fov_deg < 180))
    throw bad_input(where / "fov_deg", fmt::format("the field of view is {} degrees", camera.fov_deg), "more than 0 and less than 180");
  const auto [width, height] = camera.resolution;
  if (width < 1 || height < 1) throw bad_input(where / "resolution", fmt::format("{} x {} pixels", width, height), "at least 1 x 1");

  Camera result;
  const glm::dvec3 position = local_position(camera.position, scene, where / "position");
  const glm::dvec3 target = to_dvec3(camera.target) - scene.origin;
  if (target == position) throw bad_input(where / "target", "is where the camera stands", "another point");
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
  result.inside = dielectrics_around(scene, position);
  return result;
}

} // namespace nephroid::scene
