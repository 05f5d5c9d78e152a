// SPDX-License-Identifier: Apache-2.0
#include "scene/directions.h"
#include "scene/scene.h"

#include <cmath>
#include <numbers>

namespace nephroid::scene {

Camera make_camera(const preset::Camera& camera, const Scene& scene)
{
  const Place where = Place(scene.source) / "scene" / "camera";
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
  result.inside = dielectrics_around(scene, position);
  return result;
}

} // namespace nephroid::scene
