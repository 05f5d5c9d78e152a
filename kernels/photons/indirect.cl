// SPDX-License-Identifier: Apache-2.0
// The layer "indirect", as paths from the eye find it: light that met a diffuse surface before the last one. A path is
// bent by glass and mirrors and scattered by diffuse surfaces. Each of these from the second on adds the unbent light
// that lamps and the environment send to it. indirect_photons.cl brings the light that glass or a mirror sends to its
// first diffuse surface, but for even light of the environment (sky.h), at which paths end here. It also brings that of
// narrow spots, where the pixel shows no glass and no mirror.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/eye_path.h"
#include "kernels/tracing/work_item.h"

// 1: no glass disperses light, is coated or has a texture.
#ifndef NEPHROID_ONE_WAY
#define NEPHROID_ONE_WAY 0
#endif

#define BANDS 4 // of a path, until glass sends them different ways; then only the first goes on

typedef struct {
  Path path;
  bool is_divided;
  SET_ASIDE Band bands[BANDS];
  SET_ASIDE float throughput[BANDS]; // reflectances and n^2 behind the path; 0 where the band went another way
} Walk;

// Leaves one band, which stands for all of them from now on.
static inline void divide(Walk* walk) {
  if (NEPHROID_ONE_WAY || walk->is_divided) return;
  walk->is_divided = true;
  walk->throughput[0] *= (float)BANDS;
  for (int i = 1; i < BANDS; ++i) walk->throughput[i] = 0.0f;
}

// The XYZ that a path brings of light, as a reflector sends it.
static inline float3 brought(const World* world, const Walk* walk, Source source, Reflector reflector) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  ROLLED
  for (int i = 0; i < BANDS; ++i)
    if (walk->throughput[i] > 0.0f)
      xyz += walk->throughput[i] * carried_light(world, &walk->path.losses, source, &walk->bands[i], reflector).xyz;
  return xyz;
}

// Of the unbent light at a matt surface. narrow: of narrow spots, too. numbers: the pixel in random numbers.
IN_PLACE float3 unbent_light(const World* world, const Walk* walk, const Surface* surface, uint triangle,
                             Reflector reflector, bool narrow, uint2 seed, uint sample, uint paths, uint numbers) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (is_of_environment(world, l)) {
      const float3 rgb = sky_irradiance(world, l, &walk->path, surface, triangle, seed, sample, paths, numbers);
      const Source sky = {l, rgb / PI_F};
      if (any(sky.rgb > 0.0f)) xyz += brought(world, walk, sky, reflector);
      continue;
    }
    const DeviceLight light = world->lights[l];
    if (narrow || !is_narrow(&light)) {
      const float irradiance = irradiance_of(world, l, &walk->path, surface, triangle, seed, sample, paths, numbers);
      const Source lamp = {l, (float3)(1.0f)};
      if (irradiance > 0.0f) xyz += irradiance / PI_F * brought(world, walk, lamp, reflector);
    }
  }
  return xyz;
}

// Of the even light of the environment in the path's direction.
static inline float3 even_light(const World* world, const Walk* walk) {
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (!is_of_environment(world, l)) continue;
    const Source sky = {l, world->lights[l].radiometric * even_radiance(&world->sky, walk->path.direction)};
    return brought(world, walk, sky, white_reflector());
  }
  return (float3)(0.0f);
}

// Scatters a path at a diffuse surface. False: it ends there. random.z: decides that by what is left of its light.
static inline bool scatter(const World* world, Walk* walk, const Surface* surface, uint triangle, Reflector reflector,
                           bool may_end, float4 random) {
  const float side = dot(walk->path.direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  float most = 0.0f;
  for (int i = 0; i < BANDS; ++i) {
    walk->throughput[i] *= reflectance_of(&world->tables, reflector, walk->bands[i].wavelength);
    most = fmax(most, walk->throughput[i]);
  }
  const float chance = may_end ? fmin(most, 1.0f) : 1.0f;
  if (!(most > 0.0f) || random.z >= chance) return false;
  for (int i = 0; i < BANDS; ++i) walk->throughput[i] /= chance;
  walk->path.direction = cosine_direction(side * surface->shading, random.x, random.y);
  const float passes = part_through_coat(world, surface, walk->path.direction) *
                       part_at_normal(surface, walk->path.direction);
  for (int i = 0; i < BANDS; ++i) walk->throughput[i] *= passes;
  walk->path.origin = start_on_side(surface, side);
  walk->path.skip = triangle;
  walk->path.behind = 0.0f;
  return side * dot(walk->path.direction, surface->geometric) > 0.0f;
}

// Follows a path that has hit `hit` to its end. Returns the XYZ radiance that it brings. Photons show the light of
// narrow spots where the camera sees a surface directly; the path brings it where glass, a mirror or a coat sends it on
// first.
IN_PLACE float3 follow(const World* world, Walk* walk, Hit hit, uint2 seed, uint sample, uint paths, uint pixel) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  SET_ASIDE uint scatterings = 0u;
  bool is_bent = false; // since the last of them
  bool narrow = false;
  for (int surface_number = 0;; ++surface_number) {
    if (surface_number > 0) hit = next_hit(world, &walk->path);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) break;
    const Surface surface = surface_of(world, hit);
    const DeviceMaterial material = material_at(world, &surface, hit.primitive);
    lose_in_medium(world, &walk->path, hit.t);
    const float4 random =
        eye_numbers(seed, sample, surface_number < 2 ? paths : 0u, pixel, 1u + (uint)surface_number, STREAM_INDIRECT);
    const float2 facet = facet_numbers(seed, sample, pixel, (uint)surface_number, STREAM_INDIRECT);
    const bool ends = ends_at(world, walk->path.direction, &surface, &material, random.w, facet);
    const Reflector reflector = ends ? reflector_at(world, &surface, hit.primitive) : white_reflector();
    if (ends && scatterings > 0u)
      xyz += unbent_light(world, walk, &surface, hit.primitive, reflector, narrow, seed, sample, paths,
                          pixel + 0x9e3779b9u * scatterings);
    if (surface_number == world->scene.max_surfaces) return xyz;
    if (ends) {
      if (!scatter(world, walk, &surface, hit.primitive, reflector, scatterings > 0u, random)) return xyz;
      ++scatterings;
      is_bent = false;
      continue;
    }
    float n_ratio;
    divide(walk);
    if (!bend_path(world, &walk->path, hit.primitive, &surface, &material, &walk->bands[0], random.x, facet, &n_ratio))
      return xyz;
    for (int i = 0; i < BANDS; ++i) walk->throughput[i] *= n_ratio * n_ratio;
    is_bent = true;
    narrow = narrow || surface_number == 0;
  }
  if (NEPHROID_EVEN_SKY && is_bent && scatterings > 1u) xyz += even_light(world, walk);
  return xyz;
}

// samples: [count], each a pixel and the sample's number there. enough: as in limit_of_sample.
__kernel void indirect(WORLD_ARGUMENTS,
                       __global const float* cluster_cdf, // [cluster + 1]: chances of a path through glass
                       volatile __global long* film,
                       volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                       DeviceCamera camera, uint2 seed, __global const uint2* samples, uint count, uint enough,
                       float film_scale, float film_limit) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = eye_numbers(seed, frame, 1u, pixel, 0u, STREAM_INDIRECT);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, seed, frame, STREAM_INDIRECT, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;

  const bool unbent = is_unbent(&world, &camera, &hit);
  const uint paths = unbent ? 1u : PATHS_THROUGH_GLASS;
  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint p = 0; p < paths; ++p) {
    Walk walk = {path_from_eye(eye, outwards), false};
    for (uint i = 0; i < BANDS; ++i) {
      // The bands of each path begin with another one.
      const float place = golden_place(seed, frame, (i + p) % BANDS, BANDS, pixel, STREAM_INDIRECT_BAND);
      const int cluster = choose(cluster_cdf + 1, scene.cluster_count, place);
      const float chance = cluster_cdf[cluster + 1] - cluster_cdf[cluster];
      walk.bands[i] = choose_band(&world, scene.light_count, cluster, (place - cluster_cdf[cluster]) / chance);
      walk.bands[i].weight /= chance;
      walk.throughput[i] = 1.0f;
    }
    xyz += follow(&world, &walk, first, seed, frame * paths + p, paths, pixel) / (float)(paths * BANDS);
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, film_scale, limit_of_sample(frame, enough, film_limit),
             jitter.z);
}
