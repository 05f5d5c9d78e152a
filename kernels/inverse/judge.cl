// SPDX-License-Identifier: Apache-2.0
// The finished solid's own pictures: rays through its mesh, walls and all, by Snell's law. Its sides are black.
#include "kernels/inverse/facet_types.h"
#include "kernels/scatter/fresnel.h"
#include "kernels/tracing/bvh.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/work_item.h"

// 0: light is of one direction and one wavelength.
#ifndef NEPHROID_SPREAD
#define NEPHROID_SPREAD 1
#endif

// 1: facets spread light as slits do.
#ifndef NEPHROID_DIFFRACTION
#define NEPHROID_DIFFRACTION 1
#endif

// 1: screens are black and white.
#ifndef NEPHROID_CHANNELS
#define NEPHROID_CHANNELS 3
#endif

// A ray that has met so many surfaces is lost.
#define MAX_SURFACES 16

// `normals` has each triangle's unit normal, out of the object, and as w its PART_*.
static inline DeviceWayOut follow(global const float* nodes, global const float* blocks, int root,
                                  global const float4* normals, float n, float3 from, float3 direction) {
  DeviceWayOut way = {(float4)(0.0f), (float4)(0.0f), 1.0f, 0.0f, 0, NEPHROID_NO_PRIMITIVE};
  int surfaces = 0;
  for (; surfaces < MAX_SURFACES; ++surfaces) {
    const Hit hit = closest_hit(nodes, blocks, root, from, direction, 0.0f, INFINITY, way.leaves);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) break;
    from += hit.t * direction;
    way.leaves = hit.primitive;
    const float4 surface = normals[way.leaves];
    if (surface.w == PART_SIDE) {
      surfaces = MAX_SURFACES;
      break;
    }
    if (surface.w == PART_WALL) way.met_wall = 1;
    const bool enters = dot(surface.xyz, direction) < 0.0f;
    const float3 normal = enters ? surface.xyz : -surface.xyz;
    const float before = enters ? 1.0f : n, behind = enters ? n : 1.0f, cos_i = fmin(1.0f, -dot(normal, direction));
    const float cos_t = n < 0.0f ? -1.0f : refracted_cosine(cos_i, before / behind); // a mirror reflects all
    if (cos_t < 0.0f)
      direction = normalize(reflect_about(direction, normal, cos_i));
    else {
      const float reflected = way.part * fresnel_reflectance(cos_i, cos_t, before, behind);
      way.reflected += reflected;
      way.part -= reflected;
      direction = refract_through(direction, normal, cos_i, cos_t, before / behind);
    }
  }
  if (surfaces == 0 || surfaces == MAX_SURFACES || direction.z >= 0.0f) way.part = 0.0f;
  way.from.xyz = from;
  way.direction.xyz = direction;
  return way;
}

// Rays one by one, for closed forms.
__kernel void follow_rays(__global const float* nodes, __global const float* blocks, int root,
                          __global const float4* normals, float n, __global const float4* from,
                          __global const float4* directions, uint count, __global DeviceWayOut* ways) {
  const uint i = work_item();
  if (i < count) ways[i] = follow(nodes, blocks, root, normals, n, from[i].xyz, directions[i].xyz);
}

// Number k of ray i of a facet, 0..1, spread evenly: multiples of the powers of 1 / g, the root of g^6 = g + 1 (Roberts
// 2018, the golden ratio in five dimensions), from a random begin. In fractions of 2^32, which wrap around. The two
// numbers of diffraction take the root of g^3 = g + 1.
static inline float even_number(float begin, uint ray, uint power) {
  return (float)(((uint)(begin * 0x1p32f) + ray * power) >> 8) * 0x1p-24f;
}

#if NEPHROID_SPREAD
static inline float2 on_circle(float r, float turn) {
  float cosine;
  const float sine = sincos(2.0f * M_PI_F * turn, &cosine);
  return r * (float2)(cosine, sine);
}

// A direction that leads to `offset` in a plane across d at distance 1.
static inline float3 beside(float3 d, float2 offset) {
  const float3 a = normalize(cross(d, fabs(d.x) < 0.7f ? (float3)(1.0f, 0.0f, 0.0f) : (float3)(0.0f, 1.0f, 0.0f)));
  return normalize(d + offset.x * a + offset.y * cross(a, d));
}
#endif

#if NEPHROID_DIFFRACTION
// The number that a part u of a slit's light is before: its density is sinc^2. Its quantiles from the middle on are
// `quantiles`, SLIT_QUANTILES of them; beyond the last one there is 1 / (2 pi^2 t) of the light beyond t.
static inline float slit_number(global const float* quantiles, float u) {
  const float v = fabs(2.0f * u - 1.0f), at = v * SLIT_QUANTILES;
  const int i = (int)at;
  const float t = i + 1 < SLIT_QUANTILES ? mix(quantiles[i], quantiles[i + 1], at - (float)i)
                                         : 1.0f / (M_PI_F * M_PI_F * fmax(1.0f - v, 0x1p-24f));
  return u < 0.5f ? -t : t;
}

// A direction after a facet of this normal has spread it. The wave leaves the plane of the facets' middles, where it is
// as wide as the facet is along it. `over`: direction cosines. A z that is not below 0: no wave goes there.
static inline float3 diffracted(float3 direction, float3 normal, float2 over) {
  const float2 slope = direction.xy / -direction.z, g = normal.xy / -normal.z,
               cosines = direction.xy + over - dot(slope, over) / (1.0f + dot(slope, g)) * g;
  return (float3)(cosines, -sqrt(fmax(0.0f, 1.0f - dot(cosines, cosines))));
}
#endif

static inline void add_ray_outcome(global long* outcomes, uint item, int outcome, float light) {
  add_exactly(outcomes + RAY_OUTCOMES * (item % RAY_OUTCOME_SUMS) + outcome, convert_long_rte(light * RAY_QUANTA));
}

// Rays first .. first + count - 1 of a round: a jittered lattice on each facet, one facet after the other. Each ray of
// a facet takes one of `parts`, an index and a colour of the spectrum, and one of a lamp's places, with its power as w.
// light: [screen][y, x, z][cell].
__kernel void judge(__global const float* nodes, __global const float* blocks, int root, __global const float4* normals,
                    DeviceFront front, __global const float4* parts, __global const float* wavelengths,
                    __global const float* quantiles, __global const float4* lamp_places,
                    __global const DeviceReceiver* screens, DeviceJudgeLaunch launch, __global long* light,
                    __global long* outcomes) {
  const uint item = work_item();
  if (item >= launch.count) return;
  const uint along = (uint)front.along, rays = along * along,
             facet = launch.first_row * (uint)front.columns + item / rays, ray = item % rays;
  const uint column = facet % (uint)front.columns, row = facet / (uint)front.columns;
  const float4 random = random4(launch.seed, ray, facet, 4u * launch.turn, STREAM_JUDGE);
  const float2 at = (float2)((float)column + ((float)(ray % along) + random.x) / (float)along,
                             (float)row + ((float)(ray / along) + random.y) / (float)along);
  const float3 place =
      (float3)(at.x * front.facet_x - 0.5f * front.size_x, 0.5f * front.size_y - at.y * front.facet_y, front.entry);
  if (front.is_round && length(place.xy / (float2)(front.size_x, front.size_y)) > 0.5f) return;
#if NEPHROID_SPREAD
  const float4 begin = random4(launch.seed, 0u, facet, 4u * launch.turn + 1u, STREAM_JUDGE);
#endif
  float3 direction = front.direction.xyz;
  float part = 1.0f / (float)rays; // what a ray has of a facet's light
  if (front.lamp_weight > 0.0f) {
    float3 lamp = front.lamp.xyz;
#if NEPHROID_SPREAD
    if (front.lamp_places > 0u) {
      const float4 seen = lamp_places[(uint)(even_number(begin.x, ray, 3785032107u) * (float)front.lamp_places)];
      lamp += seen.xyz;
      part *= seen.w;
    }
#endif
    const float3 way = place - lamp;
    const float distance = length(way);
    direction = way / distance;
    part *= front.lamp_weight * -way.z / (distance * distance * distance);
  } else if (front.is_round)
    part *= 4.0f / M_PI_F;
  float n = front.n, wavelength = front.wavelength;
  float4 colour = (float4)(1.0f);
#if NEPHROID_SPREAD
  const float4 more = random4(launch.seed, 0u, facet, 4u * launch.turn + 2u, STREAM_JUDGE);
  if (front.sun_radius > 0.0f)
    direction = beside(direction, front.sun_radius * on_circle(sqrt(even_number(begin.x, ray, 3785032107u)),
                                                               even_number(begin.y, ray, 3335640777u)));
  if (front.part_step > 0u) {
    const uint which = ((uint)(more.x * (float)rays) + ray * front.part_step) % rays;
    const float4 drawn = parts[which];
    n = drawn.x;
    wavelength = wavelengths[which];
    colour = drawn.yzww;
  }
#endif
  if (front.n < 0.0f) direction.z = -direction.z; // light before a mirror is folded: app/inverse/layout.h
  DeviceWayOut out = follow(nodes, blocks, root, normals, n, place - front.before * direction, direction);
#if NEPHROID_DIFFRACTION
  if (out.part > 0.0f && normals[out.leaves].w == PART_FACET) {
    const float4 slits = random4(launch.seed, 0u, facet, 4u * launch.turn + 3u, STREAM_JUDGE);
    const float2 over =
        wavelength * (float2)(slit_number(quantiles, even_number(slits.x, ray, 3242174889u)) / front.facet_x,
                              slit_number(quantiles, even_number(slits.y, ray, 2447445414u)) / front.facet_y);
    out.direction.xyz = diffracted(out.direction.xyz, normals[out.leaves].xyz, over);
    if (!(out.direction.z < 0.0f)) out.part = 0.0f;
  }
#endif
  const float counts = part * colour.y, sent = counts * out.part;
  add_ray_outcome(outcomes, item, RAY_REFLECTED, counts * out.reflected);
  if (!(out.part > 0.0f)) {
    add_ray_outcome(outcomes, item, RAY_LOST, counts * (1.0f - out.reflected));
    return;
  }
  add_ray_outcome(outcomes, item, RAY_SENT, sent);
  if (out.met_wall) add_ray_outcome(outcomes, item, RAY_BY_WALLS, sent);
  float2 slope = out.direction.xy / -out.direction.z;
#if NEPHROID_SPREAD
  if (front.scatter > 0.0f) // two independent normal numbers of two of 0..1 (Box and Muller 1958)
    slope += front.scatter * on_circle(sqrt(-2.0f * log(1.0f - even_number(begin.z, ray, 2939605023u))),
                                       even_number(begin.w, ray, 2590590015u));
#endif
  const size_t cells = (size_t)front.cells_x * (size_t)front.cells_y;
  for (int j = 0; j < front.screens; ++j) {
    const DeviceReceiver screen = screens[j];
    const float2 hit = out.from.xy + slope * (screen.distance + out.from.z) - (float2)(screen.x, screen.y);
    const float x = floor((hit.x + 0.5f * front.receiver_x) / front.cell_x),
                y = floor((0.5f * front.receiver_y - hit.y) / front.cell_y);
    if (!(x >= 0.0f && y >= 0.0f && x < (float)front.cells_x && y < (float)front.cells_y)) continue;
    global long* cell = light + cells * NEPHROID_CHANNELS * (size_t)j + (size_t)y * (size_t)front.cells_x + (size_t)x;
    add_exactly(cell, convert_long_rte(sent * RAY_QUANTA));
#if NEPHROID_CHANNELS == 3
    add_exactly(cell + cells, convert_long_rte(part * out.part * colour.x * RAY_QUANTA));
    add_exactly(cell + 2 * cells, convert_long_rte(part * out.part * colour.z * RAY_QUANTA));
#endif
  }
}
