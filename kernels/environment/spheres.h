// SPDX-License-Identifier: Apache-2.0
// Looks up caustic spheres: E r^2 in a direction from the object's middle at a distance, between spheres and between texels. E r^2 goes
// on unchanged beyond the largest sphere, where light has left the object's neighbourhood and thins out by the inverse square.
#ifndef NEPHROID_SPHERES_H
#define NEPHROID_SPHERES_H

#include "kernels/environment/render_types.h"
#include "kernels/environment/sphere_map.h"

// Of light with a sphere: what crosses it at more of a slant is held to that.
#define LEAST_COSINE 0.125f

#ifndef NEPHROID_CHANNELS
#define NEPHROID_CHANNELS 3
#endif

// Between which spheres a distance lies: `part` of the way from sphere `lower` to `upper`.
typedef struct {
  int lower, upper;
  float part;
} Shell;

static inline Shell shell_at(__global const float* radii, int count, float distance)
{
  int upper = 0;
  while (upper < count && radii[upper] < distance) ++upper;
  Shell shell = {max(upper - 1, 0), min(upper, count - 1), 0.0f};
  if (shell.lower < shell.upper) shell.part = (distance - radii[shell.lower]) / (radii[shell.upper] - radii[shell.lower]);
  return shell;
}

// The same among both kinds of spheres.
typedef struct {
  Shell of[2]; // [DeviceTurnedSet::own]
} Shells;

static inline Shells shells_at(__global const float* radii, const DeviceSpheres* spheres, float distance)
{
  Shells shells;
  shells.of[0] = shells.of[1] = shell_at(radii, spheres->count, distance);
  if (spheres->own_count > 0) shells.of[1] = shell_at(radii + spheres->count, spheres->own_count, distance);
  return shells;
}

// Four texels about a place of a sphere's map, with bilinear weights. Over an edge of the square the map goes on at the same edge, from
// its other end.
typedef struct {
  int4 texels;
  int nearest;
  float4 weights;
} SphereTexels;

// atan2(y, x) / (pi / 2) of numbers that are not negative, not both 0. The polynomial is within 1e-5 of atan (Abramowitz and Stegun 4.4.49), a
// hundredth of a texel; atan2 itself would take a third of all time.
static inline float quarter_turns(float y, float x)
{
  const float low = fmin(x, y), high = fmax(x, y), t = low / high, t2 = t * t;
  const float angle = t * (0.9998660f + t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f)))) * (2.0f / PI_F);
  return y > x ? 1.0f - angle : angle;
}

// sphere_place of a unit vector.
static inline float2 quick_sphere_place(float3 d)
{
  const float3 a = fabs(d);
  const float r = sqrt((a.x * a.x + a.y * a.y) / (1.0f + a.z));
  const float v = r > 0.0f ? r * quarter_turns(a.y, a.x) : 0.0f, u = r - v;
  const float2 folded = d.z < 0.0f ? (float2)(1.0f - v, 1.0f - u) : (float2)(u, v);
  return 0.5f + 0.5f * copysign(folded, d.xy);
}

static inline SphereTexels sphere_texels(float3 direction, int side)
{
  const float2 place = quick_sphere_place(direction) * (float)side - 0.5f;
  const float left = floor(place.x), top = floor(place.y), u = place.x - left, v = place.y - top;
  const int x = (int)left, y = (int)top, last = side - 1;
  // Columns and rows from -1 to side: those outside are on the edge, with the other coordinate turned round.
  const int4 xs = (int4)(x, x + 1, x, x + 1), ys = (int4)(y, y, y + 1, y + 1);
  const int4 across = (xs < 0) | (xs > last), down = (ys < 0) | (ys > last);
  const int4 columns = clamp(xs, 0, last), rows = clamp(ys, 0, last);
  SphereTexels four;
  four.texels = select(rows, last - rows, across) * side + select(columns, last - columns, down);
  four.nearest = clamp((int)(place.y + 0.5f), 0, last) * side + clamp((int)(place.x + 0.5f), 0, last);
  four.weights = (float4)((1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v);
  return four;
}

// Numbers are stored as the upper halves of floats: nine bits are more than the photons' noise leaves, and no device takes long over them.
#if NEPHROID_CHANNELS == 1
typedef float Caustic;
static inline Caustic stored_caustic(__global const ushort* map, int texel) { return as_float((uint)map[texel] << 16); }
#else
typedef float3 Caustic;
static inline Caustic stored_caustic(__global const ushort* map, int texel) { return as_float3(convert_uint3(vload3((size_t)texel, map)) << 16); }
#endif

static inline Caustic sphere_caustic(__global const ushort* map, const SphereTexels* four)
{
  return four->weights.x * stored_caustic(map, four->texels.x) + four->weights.y * stored_caustic(map, four->texels.y) +
         four->weights.z * stored_caustic(map, four->texels.z) + four->weights.w * stored_caustic(map, four->texels.w);
}

static inline float3 to_bake(__global const DeviceTurnedSet* set, float3 direction)
{
  return (float3)(dot(set->to_bake[0].xyz, direction), dot(set->to_bake[1].xyz, direction), dot(set->to_bake[2].xyz, direction));
}

// E r^2 of all sets in a unit direction of the scene: linear sRGB. stored: [map][texel][channel].
static inline float3 caustic_of_sets(__global const ushort* stored, const DeviceSpheres* spheres, __global const DeviceTurnedSet* sets, int set_count,
                                     float3 direction, const Shells* shells)
{
  const size_t map_items = (size_t)(spheres->side * spheres->side) * NEPHROID_CHANNELS;
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < set_count; ++i) {
    __global const DeviceTurnedSet* set = sets + i;
    const SphereTexels four = sphere_texels(to_bake(set, direction), spheres->side);
    __global const ushort* maps = stored + (size_t)set->first_map * map_items;
    const Shell shell = shells->of[set->own];
    const Caustic lower = sphere_caustic(maps + (size_t)shell.lower * map_items, &four);
    const Caustic upper = shell.part > 0.0f ? sphere_caustic(maps + (size_t)shell.upper * map_items, &four) : lower;
    sum += set->flux.xyz * (lower + shell.part * (upper - lower));
  }
  return spheres->scale * sum;
}

// What reaches a receiver: where it is, and its unit normal on the object's side.
typedef struct {
  float3 direction, normal; // of the scene
  Shells shells;
} Receiver;

// Of all sets. ways: [map][texel], numbers of way_of.
static inline float3 received_of_sets(__global const ushort* stored, __global const ushort* ways, __global const float4* way_of,
                                      __global const float* radii, const DeviceSpheres* spheres, __global const DeviceTurnedSet* sets,
                                      int set_count, const Receiver* receiver)
{
  const size_t texels = (size_t)(spheres->side * spheres->side);
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < set_count; ++i) {
    __global const DeviceTurnedSet* set = sets + i;
    const float3 outwards = to_bake(set, receiver->direction), normal = to_bake(set, receiver->normal);
    const Shell shell = receiver->shells.of[set->own];
    const size_t first = (size_t)set->first_map;
    const size_t low = (first + (size_t)shell.lower) * texels, high = (first + (size_t)shell.upper) * texels;
    const SphereTexels four = sphere_texels(outwards, spheres->side);
    const float3 way = way_of[ways[(shell.part > 0.5f ? high : low) + (size_t)four.nearest]].xyz;
    const Caustic lower = sphere_caustic(stored + NEPHROID_CHANNELS * low, &four);
    const Caustic upper = shell.part > 0.0f ? sphere_caustic(stored + NEPHROID_CHANNELS * high, &four) : lower;
    const float factor = fmax(-dot(normal, way), 0.0f) / fmax(fabs(dot(outwards, way)), LEAST_COSINE);
    sum += (factor * set->flux.xyz) * (lower + shell.part * (upper - lower));
  }
  return spheres->scale * sum;
}

// The same of what compile.cl has made of all sets: [sphere][texel][3], linear sRGB, in coordinates of the object.
static inline float3 compiled_caustic(__global const float* compiled, const DeviceSpheres* spheres, float3 in_object, Shell shell)
{
  const SphereTexels four = sphere_texels(in_object, spheres->side);
  const size_t texels = (size_t)(spheres->side * spheres->side);
  __global const float* lower = compiled + 3 * texels * (size_t)shell.lower;
  __global const float* upper = compiled + 3 * texels * (size_t)shell.upper;
  const int t[4] = {four.texels.x, four.texels.y, four.texels.z, four.texels.w};
  const float w[4] = {four.weights.x, four.weights.y, four.weights.z, four.weights.w};
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < 4; ++i) {
    const float3 a = vload3((size_t)t[i], lower);
    sum += w[i] * (a + shell.part * (vload3((size_t)t[i], upper) - a));
  }
  return sum;
}

#endif
