// SPDX-License-Identifier: Apache-2.0
// The direct layer: paths from the eye, through glass and mirrors, to the first diffuse surface, which each light
// reaches unbent. Glass and mirrors block those shadow rays: light that passes them belongs to the caustic layer. What
// photons have left of it on receivers is found by the same paths.
#ifndef NEPHROID_RECEIVERS
#define NEPHROID_RECEIVERS 0
#endif
// 0: the paths find light on receivers alone.
#ifndef NEPHROID_DIRECT
#define NEPHROID_DIRECT 1
#endif
// 0: the environment's light is left out. 1: all light. 2: all but that is left out. A meter tells them apart.
#ifndef NEPHROID_SKY
#define NEPHROID_SKY 1
#endif
#define NEPHROID_HIGHLIGHTS NEPHROID_DIRECT
#define NEPHROID_PLACE_DIFFERENTIALS NEPHROID_RECEIVERS
#include "kernels/photons/launch_types.h"
#include "kernels/transport/branches.h"
#include "kernels/transport/eye_band.h"
#include "kernels/photons/receiver.h"
#include "kernels/transport/sweep.h"
#if NEPHROID_RECEIVERS
#include "kernels/photons/receiver_look.h"
#endif
#include "kernels/tracing/item_kernel.h"

// The XYZ radiance that paths bring: of lamps, and of light on receivers, that in quanta per square unit.
typedef struct {
  float3 direct;
  LightOfKinds kept;
} Shown;

// A sample, and where it finds light on receivers.
typedef struct {
  uint2 seed;
  uint frame, pixel;
#if NEPHROID_RECEIVERS
  const DeviceCamera* eye;
  Receivers receivers;
  __global const float* totals; // of its half
  float2 place, edges;          // of the sample in its pixel, and of its piece
#endif
} EyeSample;

// The XYZ radiance of a lamp's own surface.
static inline float3 emitted(const World* world, int light_index, const Path* path, const Band* band) {
  const Source lamp = source_lamp(light_index);
  const float3 xyz = band->cluster < 0
                         ? world->lights[light_index].as.mesh.xyz.xyz
                         : carried_light(world, &path->throughput, lamp, band, white_reflector()).xyz;
  return xyz * mesh_radiance(world, world->lights + light_index);
}

// The XYZ radiance that a diffuse surface sends back along the path. shines: with its own where it is a lamp.
IN_PLACE float3 shade(const World* world, const Path* path, const Surface* surface, uint triangle, bool shines,
                      Reflector reflector, const Band* band, uint2 seed, uint sample, uint paths, uint pixel) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (is_of_environment(world, l) ? NEPHROID_SKY == 0 : NEPHROID_SKY == 2) continue;
    if (is_of_environment(world, l)) {
      const float3 rgb = sky_irradiance(world, l, path, surface, triangle, seed, sample, paths, pixel);
      const Source sky = {l, rgb / PI_F};
      const int first = l * world->scene.reflector_count, next = world->scene.reflector_count;
      xyz += band->cluster < 0
                 ? sky.rgb.x * reflected_colour_of(world->reflected_xyz_all, first, reflector).xyz +
                       sky.rgb.y * reflected_colour_of(world->reflected_xyz_all, first + next, reflector).xyz +
                       sky.rgb.z * reflected_colour_of(world->reflected_xyz_all, first + 2 * next, reflector).xyz
                 : carried_light(world, &path->throughput, sky, band, reflector).xyz;
      continue;
    }
    if (shines && is_on_lamp(world, l, triangle)) xyz += emitted(world, l, path, band);
    const float irradiance = irradiance_of(world, l, path, surface, triangle, seed, sample, paths, pixel);
    if (irradiance == 0.0f) continue;
    const Source lamp = {l, (float3)(1.0f)};
    const float3 reflected =
        band->cluster < 0
            ? reflected_colour_of(world->reflected_xyz_all, l * world->scene.reflector_count, reflector).xyz
                          : carried_light(world, &path->throughput, lamp, band, reflector).xyz;
    xyz += reflected * (irradiance / PI_F);
  }
  return xyz;
}

// Adds what the surface at a path's end sends back along it, so much of it, to `sum`. Where the path's wavelengths go
// different ways, each quarter of its part of the spectrum has a place of its own. number: of the sample's end, so that
// each has places of lamps of its own. through: the path has met glass or a mirror; without, photons are splatted.
// spread: of EyeBranch.
IN_PLACE void shade_end(const World* world, const EyeSample* sample, const Path* path, const Interaction* at,
                        bool shines, bool through, float spread, const Band* band, uint number, uint paths,
                        uint pixel, float part, Shown* sum) {
  const int ends = ends_of_band(world, path, band);
  const bool swept = ends == ENDS_SWEPT;
#if NEPHROID_RECEIVERS
  const EyeFootprint footprint = eye_footprint(sample->eye, path, &at->surface, spread, sample->place, sample->edges);
#endif
  for (int i = 0; i < (swept ? 4 : 1); ++i) {
    Surface surface = at->surface;
    uint triangle = at->triangle;
    Band quarter = *band;
    if (swept) {
      quarter = quarter_of_band(band, i);
      move_end(world, path, beyond_leader(world, band, number_of_four_wavelengths(&band->own, i)), &surface, &triangle);
    }
#if NEPHROID_DIRECT
    sum->direct += part * shade(world, path, &surface, triangle, shines, reflector_at(world, &surface, triangle),
                                &quarter, sample->seed, number, paths, pixel);
#endif
#if NEPHROID_RECEIVERS
    if (!through) continue;
    add_light(&sum->kept, part,
              swept ? light_of_quarter(world, &sample->receivers, sample->totals, &footprint, path, &surface, band, i)
                    : light_of_end(world, &sample->receivers, sample->totals, &footprint, path, &surface, triangle,
                                   band, ends == ENDS_APART));
#endif
  }
}

// Follows the branches of path `i` of `paths` of a sample, which has hit `first`, through glass and mirrors, and adds
// what they show to `sum`. One of all wavelengths (cluster -1) ends at once on that surface, or on its
// base below a coat. With `after_base` that path has been followed already, and others do not end there.
IN_PLACE void follow(const World* world, const EyeSample* sample, const Path* path, Hit first, const Band* band,
                     bool after_base, uint i, uint paths, Shown* sum) {
  Visitor eye;
  begin_branches(&eye, path, band, sample->seed, sample->frame, i, paths, sample->pixel, STREAM_CAMERA);
  do {
    Interaction at;
    int last = 0;
    const bool at_once = band->cluster < 0;
    if (at_once) {
      at = interaction_at(world, first);
      eye.branch.share = part_to_base(world, &at.surface, path->direction);
    } else if (follow_branch(world, &eye, &first, &at, &last) != WALK_AT_BASE || (after_base && last == 0))
      continue;
    const bool shines = !eye.branch.by_microfacets && dot(eye.branch.path.direction, at.surface.geometric) < 0.0f;
    shade_end(world, sample, &eye.branch.path, &at, shines, last > 0, eye.branch.spread, band, eye.sample, paths,
              sample->pixel + 0x9e3779b9u * eye.met, eye.branch.share * eye.branch.scale, sum);
  } while (next_branch(&eye));
  sum->direct += eye.shine;
}

// samples: [count], each a pixel and the sample's number there.
ITEM_KERNEL(direct, (WORLD_ARGUMENTS, volatile __global long* film,
                     volatile __global long* seen_caustic,  // with NEPHROID_RECEIVERS: films of the light on them
                     volatile __global long* seen_indirect, // ... with two NEPHROID_KINDS_OF_LIGHT
                     volatile __global long* energy,     // [OUTCOME_COUNT]: only refused ones are counted
                     __global const int* receiver_table, __global const float* totals, // with NEPHROID_RECEIVERS
                     float radiance_per_quantum, // of light on receivers, per square unit
                     DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch),
                    (WORLD_NAMES, film, seen_caustic, seen_indirect, energy, receiver_table, totals,
                     radiance_per_quantum, camera, samples, launch)) {
  const World world = WORLD;
  if (index >= launch.count) return;
  EyeSample sample;
  sample.seed = launch.seed;
  sample.pixel = samples[index].x;
  sample.frame = samples[index].y;
  SET_ASIDE float4 jitter = place_numbers(launch.seed, sample.frame, sample.pixel);
  float3 direction;
  EYE_OF(camera);
  const Hit hit =
      first_hit(&world, eye, sample.pixel, jitter.xy, launch.seed, sample.frame, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
#if NEPHROID_RECEIVERS
  sample.receivers = receivers_of(receiver_table);
  sample.totals = totals + first_texel(&sample.receivers, sample.frame % NEPHROID_FILM_HALVES, 0, 0);
  sample.eye = eye;
  sample.place = jitter.xy;
  // Light is not even over a piece as a sky is: pieces shrink twice as fast, in proportion to the sample's number to
  // the power of -4/3, so that what a bent piece does to the mean vanishes.
  const uint number = min(sample.frame / NEPHROID_FILM_HALVES, 0xffffu);
  sample.edges = piece_edges(number * number);
#endif

  // One call of follow() for both cases: Intel's vectoriser gets two of them wrong (docs/checking.md).
  const bool unbent = is_unbent(&world, &camera, &hit);
  const DeviceMaterial met = material_of_hit(&world, &hit);
  const uint straight = unbent ? 1u : 0u, bent = unbent && !has_coat(&met) ? 0u : paths_through(&world, hit);
  SET_ASIDE float3 xyz = (float3)(0.0f), caustic = (float3)(0.0f), indirect = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint i = NEPHROID_DIRECT ? 0u : straight; i < straight + bent; ++i) {
    const Path way = path_from_eye(eye, outwards);
    const bool is_bent = i >= straight;
    Band band = whole_cluster(-1);
    float chance = 1.0f;
    if (is_bent)
      band = band_of_eye_path(&world, launch.seed, sample.frame, i - straight, bent, sample.pixel,
                              STREAM_CAMERA_CLUSTER, &chance);
    Shown shown = {(float3)(0.0f), {(float3)(0.0f), (float3)(0.0f)}};
    follow(&world, &sample, &way, first, &band, unbent, is_bent ? i - straight : 0u, is_bent ? bent : 1u, &shown);
    xyz += shown.direct / (is_bent ? chance * (float)bent : 1.0f);
    caustic += shown.kept.caustic / (float)bent;
    indirect += shown.kept.indirect / (float)bent;
  }
  const float limit = limit_of_sample(sample.frame, launch.enough, launch.film_limit);
  if (NEPHROID_DIRECT)
    add_sample(film, energy, &camera, sample.pixel, sample.frame, xyz, launch.film_scale, limit, jitter.z);
  if (!NEPHROID_RECEIVERS || bent == 0u) return;
  add_sample(seen_caustic, energy, &camera, sample.pixel, sample.frame, caustic * radiance_per_quantum,
             launch.film_scale, limit, jitter.w);
  if (NEPHROID_KINDS_OF_LIGHT > 1)
    add_sample(seen_indirect, energy, &camera, sample.pixel, sample.frame, indirect * radiance_per_quantum,
               launch.film_scale, limit, jitter.w);
}
