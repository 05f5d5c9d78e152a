// SPDX-License-Identifier: Apache-2.0
#define GLM_ENABLE_EXPERIMENTAL
#include "environment/light/distant_lights.h"

#include "environment/bake/bake.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

namespace nephroid::environment {

std::vector<DistantLight> environment_lights(const std::vector<VisibleLight>& lights, double rotate_deg) {
  std::vector<DistantLight> distant;
  for (const VisibleLight& light : lights) distant.push_back({-turned(light.direction, rotate_deg), light.flux});
  return distant;
}

std::vector<DistantLight> lamps(const scene::Scene& scene) {
  std::vector<DistantLight> lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const scene::Light& light = scene.lights[i];
    if (scene::is_environment(light)) continue;
    if (!preset::has(light.type, LIGHT_HAS_IRRADIANCE))
      throw bad_input(Location(scene.source) / "scene" / "lights" / i / "type", "is no directional light",
                      "expected \"directional\": the engine 'environment' knows light from far away only",
                      fmt::format("give it a direction: --set 'scene.lights.{}={{\"type\": \"directional\", "
                                  "\"direction\": [0, -1, 0]}}'; or "
                                  "take the engine 'spectral'",
                                  i));
    const optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(light.spectrum));
    lights.push_back({glm::dvec3(light.direction), light.irradiance_w_m2 * glm::dvec3(rgb[0], rgb[1], rgb[2])});
  }
  return lights;
}

std::vector<DistantLight> seen_lights(std::vector<DistantLight> lights, tracing::World& surroundings,
                                      const std::vector<glm::dvec3>& from) {
  Visibility visibility;
  for (DistantLight& light : lights) {
    const glm::vec3 way(-light.direction);
    const std::vector<shared::float4> to_light(from.size(), {way.x, way.y, way.z, 0});
    const std::vector<std::uint8_t> free =
        visibility.free(surroundings, compute::Buffer(surroundings.context, "direction of a lamp", to_light), 0, from);
    light.irradiance *= static_cast<double>(std::ranges::count(free, 1)) / static_cast<double>(from.size());
  }
  return lights;
}

std::vector<NearDirection> near_directions(const glm::dvec3& travel, int count) {
  const std::vector<glm::ivec3> points = cube_points(count);
  const int half = points.back().x; // half the cube's edge, in cells
  const glm::dvec3 from = -travel, size = glm::abs(from);
  const int axis = size.x >= size.y && size.x >= size.z ? 0
                   : size.y >= size.z                   ? 1
                                                        : 2,
            u = (axis + 1) % 3, v = (axis + 2) % 3;
  const glm::dvec3 place = from * (half / size[axis]); // on the cube from -half to half
  const auto cell_of = [&](double at) { return std::clamp(static_cast<int>(std::floor(at)), -half, half - 1); };
  const int first_u = cell_of(place[u]), first_v = cell_of(place[v]);
  const double part_u = place[u] - first_u, part_v = place[v] - first_v;
  std::vector<NearDirection> near;
  for (const int right : {0, 1})
    for (const int up : {0, 1}) {
      const double weight = (right ? part_u : 1 - part_u) * (up ? part_v : 1 - part_v);
      if (!(weight > 0)) continue;
      glm::ivec3 point;
      point[axis] = from[axis] > 0 ? half : -half;
      point[u] = first_u + right;
      point[v] = first_v + up;
      near.push_back({static_cast<int>(std::ranges::find(points, point) - points.begin()), weight});
    }
  return near;
}

// For nearly opposite vectors the real part of glm's quaternion is rounded off: its length is wrong, its axis right.
glm::dmat3 shortest_turn(const glm::dvec3& from, const glm::dvec3& to) {
  return glm::mat3_cast(glm::normalize(glm::rotation(from, to)));
}

std::vector<TurnedSet> turned_sets(const std::vector<DistantLight>& lights, const glm::dmat3& rotation, int count,
                                   const std::vector<double>& weights) {
  const glm::dmat3 to_object = glm::transpose(rotation);
  const std::vector<glm::dvec3> baked = light_directions(count);
  std::vector<TurnedSet> sets;
  for (const DistantLight& light : lights) {
    if (light.irradiance == glm::dvec3(0)) continue;
    const glm::dvec3 travel = to_object * light.direction;
    for (const NearDirection& near : near_directions(travel, count)) {
      const glm::dmat3 to_bake =
          glm::transpose(shortest_turn(baked[static_cast<std::size_t>(near.direction)], travel)) * to_object;
      for (std::size_t shape = 0; shape < weights.size(); ++shape)
        sets.push_back({to_bake, near.weight * weights[shape] * light.irradiance,
                        static_cast<int>(shape) * count + near.direction});
    }
  }
  return sets;
}

} // namespace nephroid::environment
