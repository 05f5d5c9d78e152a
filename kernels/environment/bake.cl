// SPDX-License-Identifier: Apache-2.0
// Algorithm 3.1 of the thesis: photons of parallel light from one direction meet an object of glass or a mirror, and
// mark each sphere about its middle that they cross afterwards, outside of it.
#include "kernels/environment/render_types.h"
#include "kernels/environment/sphere_map.h"
#include "kernels/lights/targets.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/tracing/outcomes.h"
#include "kernels/transport/scatter_path.h"

#ifndef NEPHROID_PHOTONS_PER_ITEM
#define NEPHROID_PHOTONS_PER_ITEM 1
#endif
// A map's channels: 3 for linear sRGB, 1 where all wavelengths go the same way with the same losses.
#ifndef NEPHROID_CHANNELS
#define NEPHROID_CHANNELS 3
#endif

typedef struct {
  // [sphere][texel]: the texel's channels, then power times the way it goes, over STEEPEST.
  volatile __global long* film;
  __global const float* radii; // ascending
  int count, side;              // how many spheres; texels across a map
} Spheres;

// A photon's power in quanta.
typedef struct {
  long channels[NEPHROID_CHANNELS];
  float power;
} Carried;

// Power that crosses a sphere at a slant is more light across its way, by 1 / cosine, which is held to this.
#define STEEPEST 8.0f

// way: unit.
static inline void mark_texel(const Spheres* spheres, int sphere, float3 place, float3 way, const Carried* carried) {
  const size_t texel =
      (size_t)sphere * (size_t)(spheres->side * spheres->side) + (size_t)sphere_texel(place, spheres->side);
  volatile __global long* const sums = spheres->film + (NEPHROID_CHANNELS + 3) * texel;
  for (int c = 0; c < NEPHROID_CHANNELS; ++c) add_exactly(sums + c, carried->channels[c]);
  const float cosine = fabs(dot(place, way)) / spheres->radii[sphere];
  const float3 across = way * (carried->power / fmax(STEEPEST * cosine, 1.0f));
  add_exactly(sums + NEPHROID_CHANNELS, convert_long_rte(across.x));
  add_exactly(sums + NEPHROID_CHANNELS + 1, convert_long_rte(across.y));
  add_exactly(sums + NEPHROID_CHANNELS + 2, convert_long_rte(across.z));
}

// Marks the spheres that a way of length `distance` from `origin` along the unit vector `direction` crosses. The way is
// nearest to the middle at `foot`, and crosses a sphere of radius r sqrt(r^2 - foot^2) before and after that.
static inline void mark_spheres(const Spheres* spheres, float3 origin, float3 direction, float distance,
                                const Carried* carried) {
  const float to_foot = -dot(origin, direction);
  const float3 foot = origin + to_foot * direction;
  const float foot2 = dot(foot, foot);
  for (int i = 0; i < spheres->count; ++i) {
    const float half2 = spheres->radii[i] * spheres->radii[i] - foot2;
    if (!(half2 > 0.0f)) continue;
    const float half_chord = sqrt(half2);
    const float enters = to_foot - half_chord, leaves = to_foot + half_chord;
    if (enters > 0.0f && enters <= distance) mark_texel(spheres, i, foot - half_chord * direction, direction, carried);
    if (leaves > 0.0f && leaves <= distance) mark_texel(spheres, i, foot + half_chord * direction, direction, carried);
  }
}

// light_rgb: [401] each wavelength of white light in linear sRGB; their sum is (1, 1, 1).
static inline Carried carried_by(__global const float4* light_rgb, const Band* band, float power) {
  Carried carried;
  carried.power = power;
#if NEPHROID_CHANNELS == 3
  const float3 rgb = light_rgb[band->wavelength].xyz * (band->weight * power);
  carried.channels[0] = convert_long_rte(rgb.x);
  carried.channels[1] = convert_long_rte(rgb.y);
  carried.channels[2] = convert_long_rte(rgb.z);
#else
  carried.channels[0] = convert_long_rte(power);
#endif
  return carried;
}

typedef struct {
  const Spheres* spheres;
  __global const float4* light_rgb;
  Band band;
  float power; // in quanta
  uint2 seed;
  uint number, photon;
  bool met; // the object
  SET_ASIDE float4 u;
} Visitor;

static inline Band visitor_band(const Visitor* photon) { return photon->band; }

static inline WalkNumbers visitor_numbers(Visitor* photon, const Interaction* at, int n) {
  if ((n & 3) == 0) photon->u = random4(photon->seed, photon->number, photon->photon, (uint)n / 4u, STREAM_BAKE);
  const float4 u = photon->u;
  photon->u = u.yzwx;
  const WalkNumbers numbers = {
      u.x, microfacet_numbers(photon->seed, photon->number, photon->photon, (uint)n, STREAM_BAKE)};
  return numbers;
}

static inline uint visitor_lobes(const Visitor* photon, const Interaction* at, int n) {
  return LOBE_REFLECTION | LOBE_TRANSMISSION;
}

// A photon that meets nothing more is outside, even of an open mesh that it left by the hole.
static inline void visit_segment(const World* world, Visitor* photon, const Path* path, const Hit* hit) {
  const bool leaves = hit->primitive == NEPHROID_NO_PRIMITIVE;
  if (photon->met && (leaves || is_in_air(&path->media))) {
    const Carried carried =
        carried_by(photon->light_rgb, &photon->band, photon->power * part_left(&path->throughput));
    mark_spheres(photon->spheres, path->origin, path->direction, leaves ? INFINITY : hit->t, &carried);
  }
  photon->met = photon->met || !leaves;
}

#define WALK_SEGMENTS
#define WALK_LOBES
#include "kernels/transport/walk.h"

PHOTON_KERNEL(bake, (WORLD_ARGUMENTS, __global const float4* light_rgb, __global const float* radii,
                     volatile __global long* film,
                     volatile __global long* energy, // [OUTCOME_COUNT]
                     DeviceBakeLaunch launch),
                    (WORLD_NAMES, light_rgb, radii, film, energy, launch)) {
  const World world = WORLD;
  const Spheres spheres = {film, radii, launch.sphere_count, launch.side};
  __global const DeviceLight* light = world.lights;
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint item = index * NEPHROID_PHOTONS_PER_ITEM + k;
    if (item >= launch.count) break;
    const uint photon = launch.first + item;
    const float4 start = sobol4(launch.seed, (uint3)(launch.number, 0u, 0u), 0u, photon);
    const Emission emission =
        emit_parallel(launch.direction.xyz, light->radiometric, world.targets + light->first_target,
                      light->target_count, &scene, start.zxyw); // x and y are the best pair
    const float power = emission.watts * launch.scale;
    const Band band = choose_band(&world, 0, 0, start.w);
    Path path = {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE,
                 light->inside,   full_throughput(),  emission.behind};
    Visitor visitor = {&spheres, light_rgb, band, power, launch.seed, launch.number, photon, false, (float4)(0.0f)};
    Hit hit;
    Interaction at;
    int surfaces;
    const int how = walk(&world, &visitor, &path, &hit, false, 0, &at, &surfaces);
    const int outcome = how == WALK_LOST ? OUTCOME_LOST : visitor.met ? OUTCOME_ESCAPED : OUTCOME_MISSED;
    const long quanta = convert_long_rte(power), left = convert_long_rte(power * part_left(&path.throughput));
    add_outcome(outcomes, OUTCOME_EMITTED, quanta);
    add_outcome(outcomes, outcome, left);
    add_outcome(outcomes, OUTCOME_ABSORBED, quanta - left);
  }
}
