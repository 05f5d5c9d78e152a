// SPDX-License-Identifier: Apache-2.0
// Each light's unbent light at a surface that a path from the eye meets.
#include "kernels/lights/emission.h"
#include "kernels/lights/spectrum.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/scatter/scatter.h"

// The irradiance in W m^-2 that a light's whole spectrum gives a surface point, without shadows, and the way to the
// light. It is I cos(theta) / d^2, with the intensity I = P / (4 pi) of a point, P / (its cone's solid angle) of a
// spot, P cos(theta') / pi of a place of an area light; E cos(theta) for directional light.
typedef struct {
  float irradiance;
  float3 direction;
  float distance; // INFINITY: directional
} Arrival;

static inline Arrival arrive_from(const DeviceLight* light, float3 position, float3 normal, float metres_per_unit,
                                  float2 place) {
  Arrival arrival = {0.0f, -light->direction.xyz, INFINITY};
  if (is_light(light, LIGHT_DIRECTIONAL)) {
    arrival.irradiance = light->radiometric * max(dot(arrival.direction, normal), 0.0f);
    return arrival;
  }
  const float3 source = is_light(light, LIGHT_AREA) ? area_point(light, place) : light->position.xyz;
  const float3 way = source - position;
  arrival.distance = length(way);
  arrival.direction = way / arrival.distance;
  const float cosine = max(dot(arrival.direction, normal), 0.0f);
  const float cos_light = -dot(arrival.direction, light->direction.xyz);
  float watts_per_steradian = light->radiometric / (4.0f * PI_F);
  if (is_light(light, LIGHT_SPOT))
    watts_per_steradian = in_spot(light, -arrival.direction) ? light->radiometric / light->solid_angle : 0.0f;
  if (is_light(light, LIGHT_AREA)) watts_per_steradian = light->radiometric * max(cos_light, 0.0f) / PI_F;
  const float metres = arrival.distance * metres_per_unit;
  arrival.irradiance = watts_per_steradian * cosine / (metres * metres);
  return arrival;
}

// The same of a light in the world, as choose_in_lamp leaves it.
static inline Arrival arrive_from_lamp(const World* world, const DeviceLight* light, float3 position, float3 normal,
                                       float2 place) {
  Arrival arrival = arrive_from(light, position, normal, world->scene.metres_per_unit, place);
  arrival.irradiance *= photometric(world, light, -arrival.direction);
  return arrival;
}

// Whether something hides a lamp from a surface. from: where rays start on the lamp's side.
static inline bool is_hidden(const World* world, const Surface* surface, float3 from, const Arrival* arrival,
                             uint triangle) {
#if NEPHROID_LIGHT_TYPES >> LIGHT_MESH & 1
  if (!isinf(arrival->distance)) { // to the place itself: a mesh would hide one beside it at grazing angles
    const float3 way = surface->position + arrival->distance * arrival->direction - from;
    const float distance = length(way);
    return is_blocked(world, from, way / distance, distance * UP_TO_LAMP, triangle);
  }
#endif
  return is_blocked(world, from, arrival->direction, arrival->distance, triangle);
}

// The four numbers of sample `sample` of a light that has places (light.h) at a pixel. A pass takes `paths` samples.
// The samples of each half of the film follow a sequence, whose sets 0 and 1 belong to photons.
static inline float4 light_numbers(const DeviceLight* light, uint2 seed, uint sample, uint paths, uint pixel) {
#if NEPHROID_LOW_DISCREPANCY
  const uint frame = sample / paths, index = frame / NEPHROID_FILM_HALVES * paths + sample % paths;
  return sobol4(seed, (uint3)(pixel, (uint)light->number, frame % NEPHROID_FILM_HALVES), 2u, index);
#else
  return random4(seed, sample, pixel, (uint)light->number, STREAM_CAMERA_LIGHT);
#endif
}

// The irradiance of a light's unbent light on the side of a surface that a path arrives at, or on the base below its
// coat; 0 where something hides it.
static inline float irradiance_of(const World* world, int light_index, const Path* path, const Surface* surface,
                                  uint triangle, uint2 seed, uint sample, uint paths, uint pixel) {
  DeviceLight light = world->lights[light_index];
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float4 place = has_lamp_places(&light) ? light_numbers(&light, seed, sample, paths, pixel) : (float4)(0.0f);
  choose_in_lamp(world, &light, place.xy);
  const Arrival arrival = arrive_from_lamp(world, &light, surface->position, side * surface->shading, place.xy);
  if (!(arrival.irradiance > 0.0f) || !(side * dot(arrival.direction, surface->geometric) > 0.0f)) return 0.0f;
  const float3 from = start_on_side(surface, side);
  if (is_hidden(world, surface, from, &arrival, triangle)) return 0.0f;
  return arrival.irradiance * part_to_base(world, surface, arrival.direction) *
         part_at_normal(surface, arrival.direction);
}

// The irradiance times Source::rgb of the environment's unbent light on the side of a surface that a path arrives at.
// It takes two shadow rays, one drawn by the map's peaks and one by the cosine, weighted by the balance heuristic
// (Veach 1997, 9.2.2): each adds radiance * cosine over the sum of both densities. The first finds a sun, the second is
// exact where the sky is even. Without peaks it is the only one.
static inline float3 sky_irradiance(const World* world, int light_index, const Path* path, const Surface* surface,
                                    uint triangle, uint2 seed, uint sample, uint paths, uint pixel) {
  const DeviceLight light = world->lights[light_index];
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 normal = side * surface->shading, from = start_on_side(surface, side);
  SET_ASIDE float4 random = light_numbers(&light, seed, sample, paths, pixel);
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
  return light.radiometric * sum;
}
