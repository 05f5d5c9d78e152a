// SPDX-License-Identifier: Apache-2.0
// The layer "indirect", as paths from the eye find it: light that met a diffuse surface before the last one. A path is
// bent by glass and mirrors and scattered by diffuse surfaces. Each of these from the second on adds the unbent light
// that lamps and the environment send to it. indirect_photons.cl brings the light that glass or a mirror sends to its
// first diffuse surface, but for even light of the environment (sky.h), at which paths end here. It also brings that of
// narrow spots, where the pixel shows no glass and no mirror.
// 1: some glass is coated, and reflects each wavelength otherwise.
#ifndef NEPHROID_COATED
#define NEPHROID_COATED 0
#endif
#include "kernels/photons/launch_types.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_band.h"
#include "kernels/transport/eye_path.h"
#include "kernels/transport/scatter_path.h"

typedef struct {
  uint2 seed;
  uint sample, paths, pixel; // of eye_numbers
  SET_ASIDE float3 xyz;      // what the path has brought
  SET_ASIDE uint scatterings;
  bool is_bent; // since the last of them
  bool narrow;  // it brings the light of narrow spots, too
  bool is_split;            // glass has split the four wavelengths of its band
  uint parts, with_leader;  // of the spectrum; bits: which of the four are in the leader's
  Band band;
  SET_ASIDE float throughput[4]; // reflectances and n^2 behind the path; 0 where the wavelength went another way
} Visitor;

// Lets those in the leader's part of the spectrum stand for all four from now on.
static inline void leave_part_of_leader(Visitor* eye) {
  if (eye->is_split) return;
  eye->is_split = true;
  for (int i = 0; i < 4; ++i) eye->throughput[i] *= (eye->with_leader >> i & 1u) != 0u ? (float)eye->parts : 0.0f;
}

// The XYZ that a path brings of light, as a reflector sends it.
static inline float3 brought(const World* world, const Visitor* eye, const Path* path, Source source,
                             Reflector reflector) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  ROLLED
  for (int i = 0; i < 4; ++i)
    if (eye->throughput[i] > 0.0f) {
      Throughput throughput = path->throughput;
      throughput.own.four.x = number_of_four(throughput.own.four, i);
      const Band band = one_wavelength(0, number_of_four_wavelengths(&eye->band.own, i),
                                       4.0f * number_of_four(eye->band.own.weights, i));
      xyz += eye->throughput[i] * carried_light(world, &throughput, source, &band, reflector).xyz;
    }
  return xyz;
}

// Of the unbent light at a matt surface.
IN_PLACE float3 unbent_light(const World* world, const Visitor* eye, const Path* path, const Interaction* at,
                             Reflector reflector) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  const uint numbers = eye->pixel + 0x9e3779b9u * eye->scatterings;
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (is_of_environment(world, l)) {
      const float3 rgb =
          sky_irradiance(world, l, path, &at->surface, at->triangle, eye->seed, eye->sample, eye->paths, numbers);
      const Source sky = {l, rgb / PI_F};
      if (any(sky.rgb > 0.0f)) xyz += brought(world, eye, path, sky, reflector);
      continue;
    }
    if (eye->narrow || !is_narrow(world->lights + l)) {
      const float irradiance =
          irradiance_of(world, l, path, &at->surface, at->triangle, eye->seed, eye->sample, eye->paths, numbers);
      const Source lamp = {l, (float3)(1.0f)};
      if (irradiance > 0.0f) xyz += irradiance / PI_F * brought(world, eye, path, lamp, reflector);
    }
  }
  return xyz;
}

// Of the even light of the environment in the path's direction.
static inline float3 even_light(const World* world, const Visitor* eye, const Path* path) {
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (!is_of_environment(world, l)) continue;
    const Source sky = {l, world->lights[l].radiometric * even_radiance(&world->sky, path->direction)};
    return brought(world, eye, path, sky, white_reflector());
  }
  return (float3)(0.0f);
}

static inline Band visitor_band(const Visitor* eye) { return eye->band; }

static inline float4 walk_numbers(const Visitor* eye, int n) {
  return eye_numbers(eye->seed, eye->sample, n < 2 ? eye->paths : 0u, eye->pixel, 1u + (uint)n, STREAM_INDIRECT);
}

static inline WalkNumbers visitor_numbers(const Visitor* eye, const Interaction* at, int n) {
  const float4 random = walk_numbers(eye, n);
  const WalkNumbers numbers = {has_coat(&at->material) ? random.w : random.x,
                               microfacet_numbers(eye->seed, eye->sample, eye->pixel, (uint)n, STREAM_INDIRECT)};
  return numbers;
}

// Adds the unbent light that falls on a diffuse surface, from the second of them on, and scatters the path there.
// random.z: decides by what is left of its light whether it ends.
static inline bool visit_base(const World* world, Visitor* eye, Path* path, const Interaction* at, int n) {
  const Reflector reflector = reflector_at(world, &at->surface, at->triangle);
  if (eye->scatterings > 0u) eye->xyz += unbent_light(world, eye, path, at, reflector);
  if (n == world->scene.max_surfaces) return false;
  const float4 random = walk_numbers(eye, n);
  const float side = dot(path->direction, at->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  float most = 0.0f;
  for (int i = 0; i < 4; ++i) {
    eye->throughput[i] *= reflectance_of(&world->tables, reflector, number_of_four_wavelengths(&eye->band.own, i));
    most = fmax(most, eye->throughput[i]);
  }
  const float chance = eye->scatterings > 0u ? fmin(most, 1.0f) : 1.0f;
  if (!(most > 0.0f) || random.z >= chance) return false;
  for (int i = 0; i < 4; ++i) eye->throughput[i] /= chance;
  path->direction = cosine_direction(side * at->surface.shading, random.x, random.y);
  const float passes =
      part_to_base(world, &at->surface, path->direction) * part_at_normal(&at->surface, path->direction);
  for (int i = 0; i < 4; ++i) eye->throughput[i] *= passes;
  path->origin = start_on_side(&at->surface, side);
  path->skip = at->triangle;
  path->behind = 0.0f;
  ++eye->scatterings;
  eye->is_bent = false;
  return side * dot(path->direction, at->surface.geometric) > 0.0f;
}

static inline bool visit_scatter(const World* world, Visitor* eye, const Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  if (path->throughput.is_split) leave_part_of_leader(eye);
  for (int i = 0; i < 4; ++i) eye->throughput[i] *= sample->n_ratio * sample->n_ratio;
  eye->is_bent = true;
  eye->narrow = eye->narrow || n == 0;
  return true;
}

#define WALK_BASES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// Follows a path that has hit `hit` to its end. Returns the XYZ radiance that it brings. Photons show the light of
// narrow spots where the camera sees a surface directly; the path brings it where glass, a mirror or a coat sends it on
// first.
IN_PLACE float3 follow(const World* world, Visitor* eye, Path path, Hit hit) {
  eye->xyz = (float3)(0.0f);
  eye->scatterings = 0u;
  eye->is_split = eye->is_bent = eye->narrow = false;
  Interaction at;
  int last;
  const int how = walk(world, eye, &path, &hit, true, 0, &at, &last);
  if (NEPHROID_EVEN_SKY && how == WALK_LEFT && eye->is_bent && eye->scatterings > 1u)
    return eye->xyz + even_light(world, eye, &path);
  return eye->xyz;
}

// samples: [count], each a pixel and the sample's number there.
ITEM_KERNEL(indirect, (WORLD_ARGUMENTS,
                       volatile __global long* film,
                       volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                       DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch),
                      (WORLD_NAMES, film, energy, camera, samples, launch)) {
  const World world = WORLD;
  if (index >= launch.count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = place_numbers(launch.seed, frame, pixel);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, launch.seed, frame, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;

  const bool unbent = is_unbent(&world, &camera, &hit);
  const uint paths = unbent ? 1u : PATHS_THROUGH_GLASS;
  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint p = 0; p < paths; ++p) {
    Visitor visitor;
    visitor.seed = launch.seed;
    visitor.sample = frame * paths + p;
    visitor.paths = paths;
    visitor.pixel = pixel;
    // As in place_in_spectrum, but where light goes on from walls.
    const uint number = frame / SAMPLE_SEQUENCES * paths + p;
    visitor.parts = number >= (NEPHROID_COATED ? 0u : 64u) ? 4u : number >= 16u ? 2u : 1u;
    visitor.with_leader = 0u;
    uint part_of_leader = 0u;
    DrawnWavelength drawn[4];
    const float leads = golden_place_of_four(launch.seed, frame, p, pixel, STREAM_INDIRECT_BAND);
    for (int i = 0; i < 4; ++i) {
      const float place = quarters_on(leads, i);
      float chance, within;
      const int cluster = cluster_at(&world, place, &chance, &within);
      drawn[i] = draw_wavelength(&world, scene.light_count, cluster, within);
      drawn[i].weight /= chance;
      if (i == 0) visitor.band = one_wavelength(cluster, drawn[0].wavelength, drawn[0].weight);
      visitor.throughput[i] = 1.0f;
      const uint part = (uint)(place * (float)visitor.parts);
      if (i == 0) part_of_leader = part;
      visitor.with_leader |= part == part_of_leader ? 1u << i : 0u;
    }
    visitor.band.own = carriers_of(drawn[0], drawn[1], drawn[2], drawn[3], drawn[0].wavelength);
    xyz += follow(&world, &visitor, path_from_eye(eye, outwards), first) / (float)(paths * 4u);
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
