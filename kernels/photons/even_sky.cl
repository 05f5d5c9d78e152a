// SPDX-License-Identifier: Apache-2.0
// The part of the layer "caustic" that is the even light of the environment (sky.h). Paths from the eye go through
// glass and mirrors to the first diffuse surface, and on through glass and mirrors to the sky. Light that comes from
// everywhere is found more surely from where it falls than from where it starts.
#include "kernels/photons/launch_types.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_band.h"
#include "kernels/transport/eye_walk.h"

#define BOUNCES 4u // of a sample, each in a band of its own

// A direction from a surface towards glass or a mirror, and cosine / density. normal: of the side that is lit. Small
// targets are drawn; where they fill half of what is above, the cosine is as good.
static inline float3 direction_to_targets(__global const DeviceTarget* targets, int target_count, float3 from,
                                          float3 normal, float4 random, float* weight) {
  float sum = 0.0f;
  for (int i = 0; i < target_count; ++i) sum += one_minus_cos_of(targets[i].centre_radius, from);
  *weight = PI_F;
  if (sum > 0.5f) return cosine_direction(normal, random.x, random.y);
  Emission towards = {from, normal, 0.0f, 0.0f};
  const float steradians = sample_targets(targets, target_count, from, random, &towards);
  *weight = steradians * dot(towards.direction, normal);
  return towards.direction;
}

// The irradiance times Source::rgb of even light that reaches a diffuse surface through glass and mirrors, on the side
// that `path` arrives at. Continues the path from there.
IN_PLACE float3 even_irradiance(const World* world, __global const DeviceLight* light,
                           Path* path, const Surface* surface, uint triangle, const Band* band, uint2 seed, uint sample,
                           uint pixel) {
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  path->origin = start_on_side(surface, side);
  path->skip = triangle;
  path->behind = 0.0f;
  const float4 random = eye_numbers(seed, sample, BOUNCES, pixel, 0u, STREAM_EVEN_SKY_BOUNCE);
  float weight;
  path->direction = direction_to_targets(world->targets + light->first_target, light->target_count, path->origin,
                                         side * surface->shading, random, &weight);
  if (!(weight > 0.0f) || !(side * dot(path->direction, surface->geometric) > 0.0f)) return (float3)(0.0f);
  weight *= part_to_base(world, surface, path->direction) * part_at_normal(surface, path->direction);
  Hit hit = next_hit(world, path);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return (float3)(0.0f); // unbent light is of the layer "direct"
  Visitor eye = eye_visitor(band, seed, sample, BOUNCES, pixel, STREAM_EVEN_SKY_BOUNCE);
  Interaction at;
  int last;
  weight *= follow_eye_path(world, &eye, path, &hit, &at, &last);
  if (weight == 0.0f || hit.primitive != NEPHROID_NO_PRIMITIVE) return (float3)(0.0f);
  return light->radiometric * weight * even_radiance(&world->sky, path->direction);
}

// samples: [count], each a pixel and the sample's number there.
ITEM_KERNEL(even_sky, (WORLD_ARGUMENTS, int light_index,
                       volatile __global long* film,
                       volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                       DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch),
                      (WORLD_NAMES, light_index, film, energy, camera, samples, launch)) {
  const World world = WORLD;
  if (index >= launch.count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = place_numbers(launch.seed, frame, pixel);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, launch.seed, frame, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;

  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint i = 0; i < BOUNCES; ++i) {
    const uint sample = frame * BOUNCES + i;
    float chance;
    const Band band = band_of_eye_path(&world, launch.seed, frame, i, BOUNCES, pixel, STREAM_EVEN_SKY_CLUSTER, &chance);
    Path way = path_from_eye(eye, outwards);
    Hit end = first;
    Visitor eye = eye_visitor(&band, launch.seed, sample, BOUNCES, pixel, STREAM_EVEN_SKY);
    Interaction at;
    const float radiance_scale = reach_base(&world, &eye, &way, &end, &at);
    if (radiance_scale == 0.0f) continue;
    const float3 irradiance =
        even_irradiance(&world, world.lights + light_index, &way, &at.surface, at.triangle, &band, launch.seed, sample,
                        pixel);
    const Source sky = {light_index, irradiance};
    xyz += carried_light(&world, &way.throughput, sky, &band, reflector_at(&world, &at.surface, at.triangle)).xyz *
           (radiance_scale / (PI_F * chance * (float)BOUNCES));
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
