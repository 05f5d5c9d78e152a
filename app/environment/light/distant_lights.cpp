// SPDX-License-Identifier: Apache-2.0
#include "environment/light/distant_lights.h"

#include "base/error.h"
#include "optics/colour.h"
#include "tracing/scene_buffers.h"

namespace nephroid::environment {

std::vector<DistantLight> environment_lights(const std::vector<VisibleLight>& lights, double rotate_deg)
{
  std::vector<DistantLight> distant;
  for (const VisibleLight& light : lights) distant.push_back({-turned(light.direction, rotate_deg), light.flux, light.spread_deg});
  return distant;
}

std::vector<DistantLight> lamps(const scene::Scene& scene)
{
  std::vector<DistantLight> lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const scene::Light& light = scene.lights[i];
    if (scene::is_environment(light)) continue;
    if (light.type != preset::Light::Type::directional)
      throw bad_input(Place(scene.source) / "scene" / "lights" / i / "type", "is no directional light",
                      "expected \"directional\": the engine 'environment' knows light from far away only",
                      "make it directional, or take the engine 'spectral'");
    const optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(light.spectrum));
    lights.push_back({glm::dvec3(light.direction), light.irradiance_w_m2 * glm::dvec3(rgb[0], rgb[1], rgb[2])});
  }
  return lights;
}

std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings, const glm::dvec3& from)
{
  std::vector<shared::float4> to_lights;
  for (const DistantLight& light : lights)
    to_lights.push_back(
        {-static_cast<float>(light.direction.x), -static_cast<float>(light.direction.y), -static_cast<float>(light.direction.z), 0});
  const std::vector<std::uint8_t> free =
      Sight().free(surroundings, tracing::upload_vector(surroundings.context, "directions of lamps", to_lights), 0, from);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (!free[i]) lights[i].irradiance = glm::dvec3(0);
  return lights;
}

} // namespace nephroid::environment
