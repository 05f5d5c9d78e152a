// SPDX-License-Identifier: Apache-2.0
#include "environment/light/distant_lights.h"

#include "base/error.h"
#include "optics/colour.h"

#include "tracing/world.h"
#include <algorithm>

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

std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings, const std::vector<glm::dvec3>& from)
{
  for (DistantLight& light : lights) {
    const glm::vec3 way(-light.direction);
    const std::vector<shared::float4> to_light(from.size(), {way.x, way.y, way.z, 0});
    const std::vector<std::uint8_t> free =
        Sight().free(surroundings, tracing::upload_vector(surroundings.context, "direction of a lamp", to_light), 0, from);
    light.irradiance *= static_cast<double>(std::ranges::count(free, 1)) / static_cast<double>(from.size());
  }
  return lights;
}

} // namespace nephroid::environment
