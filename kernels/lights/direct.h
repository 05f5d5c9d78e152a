// SPDX-License-Identifier: Apache-2.0
// Each light's unbent light at a surface that a path from the eye meets.
#include "kernels/lights/lights.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/scatter/scatter.h"

// Whether something hides a lamp from a surface. from: where rays start on the lamp's side.
static inline bool is_hidden(const World* world, const Surface* surface, float3 from, const LightSample* sample,
                             uint triangle) {
  if (HAS_LIGHTS(LIGHT_MESH) && !isinf(sample->distance)) { // to the place itself: a mesh would hide one beside it
    const float3 way = surface->position + sample->distance * sample->direction - from;
    const float distance = length(way);
    return is_blocked(world, from, way / distance, distance * UP_TO_LAMP, triangle);
  }
  return is_blocked(world, from, sample->direction, sample->distance, triangle);
}

// The four numbers of sample `sample` of a light that has places at a pixel. A pass takes `paths` samples.
// The samples of each half of the film follow a sequence, whose sets 0 and 1 belong to photons.
static inline float4 light_numbers(__global const DeviceLight* light, uint2 seed, uint sample, uint paths, uint pixel) {
#if NEPHROID_LOW_DISCREPANCY
  const uint frame = sample / paths, index = frame / NEPHROID_FILM_HALVES * paths + sample % paths;
  return sobol4(seed, (uint3)(pixel, (uint)light->number, frame % NEPHROID_FILM_HALVES), 2u, index);
#else
  return random4(seed, sample, pixel, (uint)light->number, STREAM_CAMERA_LIGHT);
#endif
}

// sample_towards with these numbers, of a lamp at a point of a surface.
static inline LightSample sample_lamp(const World* world, int light_index, float3 position, float3 normal, uint2 seed,
                                      uint sample, uint paths, uint pixel) {
  __global const DeviceLight* light = world->lights + light_index;
  const float4 u = has_places(light) ? light_numbers(light, seed, sample, paths, pixel) : (float4)(0.0f);
  return sample_towards(world, light, position, normal, u.xy);
}

// The irradiance of a light's unbent light on the side of a surface that a path arrives at, or on the base below its
// coat; 0 where something hides it.
static inline float irradiance_of(const World* world, int light_index, const Path* path, const Surface* surface,
                                  uint triangle, uint2 seed, uint sample, uint paths, uint pixel) {
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const LightSample of_lamp =
      sample_lamp(world, light_index, surface->position, side * surface->shading, seed, sample, paths, pixel);
  if (!(of_lamp.irradiance > 0.0f) || !(side * dot(of_lamp.direction, surface->geometric) > 0.0f)) return 0.0f;
  const float3 from = start_on_side(surface, side);
  if (is_hidden(world, surface, from, &of_lamp, triangle)) return 0.0f;
  return of_lamp.irradiance * part_to_base(world, surface, of_lamp.direction) *
         part_at_normal(surface, of_lamp.direction);
}

// The irradiance times Source::rgb of the environment's unbent light on the side of a surface that a path arrives at.
// It takes two shadow rays, one drawn by the map's peaks and one by the cosine, weighted by the balance heuristic
// (Veach 1997, 9.2.2): each adds radiance * cosine over the sum of both densities. The first finds a sun, the second is
// exact where the sky is even. Without peaks it is the only one.
static inline float3 sky_irradiance(const World* world, int light_index, const Path* path, const Surface* surface,
                                    uint triangle, uint2 seed, uint sample, uint paths, uint pixel) {
  __global const DeviceLight* light = world->lights + light_index;
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 normal = side * surface->shading, from = start_on_side(surface, side);
  SET_ASIDE float4 random = light_numbers(light, seed, sample, paths, pixel);
  SET_ASIDE float3 sum = (float3)(0.0f);
  for (int i = world->sky.size.has_peaks ? 0 : 1; i < 2; ++i) {
    const SkyPlace place = i == 0 ? sample_sky(&world->sky, cdf_of_peaks(&world->sky), random.xy)
                                  : sky_in(&world->sky, cosine_direction(normal, random.z, random.w));
    const float cosine = dot(place.direction, normal);
    if (!(cosine > 0.0f) || !(place.density > 0.0f) || !(side * dot(place.direction, surface->geometric) > 0.0f))
      continue;
    SET_ASIDE float3 rgb = place.rgb;
    SET_ASIDE float weight = place.density * cosine / (place.peak_density + cosine / PI_F) *
                             part_to_base(world, surface, place.direction) *
                             part_at_normal(surface, place.direction);
    if (!is_blocked(world, from, place.direction, INFINITY, triangle)) sum += rgb * weight;
  }
  return light->radiometric * sum;
}
