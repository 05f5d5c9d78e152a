// SPDX-License-Identifier: Apache-2.0
#include "scene/directions.h"
#include "scene/materials.h"
#include "scene/scene.h"

#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

/// Edges of the rectangle, edge_v along up, so that edge_u x edge_v points along direction.
void set_edges(const preset::Light& light, const glm::dvec3& direction, const Place& where, Light& result)
{
  const glm::dvec3 up = perpendicular_up(light.up, direction, where / "up");
  result.edge_u = light.size[0] * glm::cross(up, direction);
  result.edge_v = light.size[1] * up;
}

} // namespace

Light make_light(const preset::Light& light, const Scene& scene, const Place& where)
{
  using Type = preset::Light::Type;
  Light result;
  result.type = light.type;
  result.spectrum = make_light_spectrum(light.spectrum, where / "spectrum");
  if (light.type != Type::point) {
    const glm::dvec3 direction = unit_direction(to_dvec3(light.direction), where / "direction");
    result.direction = direction;
    if (light.type == Type::area) set_edges(light, direction, where, result);
  }
  if (light.type == Type::spot) result.cos_half_angle = std::cos(light.half_angle_deg * std::numbers::pi / 180);
  if (light.type == Type::directional) {
    result.irradiance_w_m2 = light.irradiance_w_m2;
    return result; // comes from far away: inside nothing
  }
  result.power_w = light.power_w;
  const glm::dvec3 position = local_position(light.position, scene, where / "position");
  result.position = position;
  result.inside = dielectrics_around(scene, position);
  return result;
}

} // namespace nephroid::scene
