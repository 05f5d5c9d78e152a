// SPDX-License-Identifier: Apache-2.0
#include "ui/view/sight.h"

#include <cmath>
#include <cstddef>

namespace nephroid::ui {

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

} // namespace nephroid::ui
