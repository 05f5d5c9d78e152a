// SPDX-License-Identifier: Apache-2.0
// Looks up caustic spheres: E r^2 in a direction and at a distance from the object's middle, interpolated between
// spheres and texels. Beyond the largest sphere E r^2 stays: light thins out by the inverse square.
#include "kernels/environment/render_types.h"
#include "kernels/environment/sphere_map.h"

#ifndef NEPHROID_CHANNELS
#define NEPHROID_CHANNELS 3
#endif

// The spheres that a distance lies between: `part` of the way from sphere `lower` to `upper`.
typedef struct {
  int lower, upper;
  float part;
} Shell;

static inline Shell shell_at(__global const float* radii, int count, float distance) {
  int upper = 0;
  while (upper < count && radii[upper] < distance) ++upper;
  Shell shell = {max(upper - 1, 0), min(upper, count - 1), 0.0f};
  if (shell.lower < shell.upper)
    shell.part = (distance - radii[shell.lower]) / (radii[shell.upper] - radii[shell.lower]);
  return shell;
}

// The factor of E r^2 within the smallest sphere: E stays, because light inside is not known, and r^2 goes to 0.
static inline float held(__global const float* radii, float distance) {
  const float part = fmin(distance / radii[0], 1.0f);
  return part * part;
}

// The place of a unit vector in a sphere's map, in texels from the middle of the border's outermost texel. Its whole
// part is the column and the row of the first of the four texels about it, its fraction the weight of the others.
// atan(t) / (pi / 2) is a polynomial within 1e-5 (Abramowitz and Stegun 4.4.49), a hundredth of a texel; atan2 would
// take a third of all time. REAL: float, or float8 for eight vectors at once.
#define DEFINE_STORED_PLACE(NAME, REAL)                                                                                \
  static inline void NAME(REAL x, REAL y, REAL z, float side, REAL* column, REAL* row)                                 \
  {                                                                                                                    \
    const REAL a = fabs(x), b = fabs(y), zero = 0.0f, one = 1.0f;                                                      \
    const REAL r = sqrt((a * a + b * b) / (1.0f + fabs(z)));                                                           \
    const REAL t = (b > a ? a : b) / (b > a ? b : a), t2 = t * t;                                                      \
    const REAL atan_t =                                                                                                \
        t * (0.9998660f + t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));              \
    const REAL quarters = atan_t * (2.0f / PI_F);                                                                      \
    const REAL v = r > zero ? r * (b > a ? one - quarters : quarters) : zero, u = r - v;                               \
    *column = 0.5f + side * (0.5f + 0.5f * copysign(z < zero ? one - v : u, x));                                       \
    *row = 0.5f + side * (0.5f + 0.5f * copysign(z < zero ? one - u : v, y));                                          \
  }
DEFINE_STORED_PLACE(stored_place, float)

// The texel of a map of side x side that a texel of its stored form repeats. The stored form's border has what is over
// the edge: there the square goes on at the same edge, from its other end.
static inline int texel_of_stored(int stored, int side) {
  const int stride = side + 2, last = side - 1, column = stored % stride - 1, row = stored / stride - 1;
  const bool across = column < 0 || column > last, down = row < 0 || row > last;
  const int x = clamp(column, 0, last), y = clamp(row, 0, last);
  return (across ? last - y : y) * side + (down ? last - x : x);
}

// Maps in their stored form, direction after direction (render_types.h).
typedef struct {
  __global const uchar* texels;  // [map][texel]: steps of brightness
  __global const ushort* blocks; // [map]: the ways of all blocks, indices into way_of; their steps; of 3 channels,
                                 // their colours
  __global const float4* way_of; // unit vectors
} Maps;

static inline size_t texels_of_map(const DeviceSpheres* spheres) {
  return (size_t)((spheres->side + 2) * (spheres->side + 2));
}
static inline size_t blocks_of_map(const DeviceSpheres* spheres) {
  return (size_t)(BLOCKS_ACROSS(spheres->side) * BLOCKS_DOWN(spheres->side));
}
// How many numbers a map has in Maps::blocks.
#define ITEMS_OF_BLOCK (NEPHROID_CHANNELS == 3 ? 3 : 2)

// The least cosine between a sphere's normal and its light's way that counts.
#define LEAST_COSINE 0.125f

// The texels of a map in its stored form that a place lies between.
typedef struct {
  size_t texels[4], blocks[4];
  float weights[4];
  size_t nearest_block;
} FourTexels;

// The block of a texel of the stored form.
static inline size_t block_of(int column, int row, int side) {
  return (size_t)((row >> BLOCK_DOWN_BITS) * BLOCKS_ACROSS(side) + (column >> BLOCK_ACROSS_BITS));
}

// direction: unit, in the map's coordinates.
static inline FourTexels four_texels(float3 direction, int side) {
  float column, row;
  stored_place(direction.x, direction.y, direction.z, (float)side, &column, &row);
  const int stride = side + 2, left = (int)column, top = (int)row;
  const float u = column - (float)left, v = row - (float)top;
  const size_t first = (size_t)(top * stride + left);
  const FourTexels four = {{first, first + 1, first + (size_t)stride, first + (size_t)stride + 1},
                           {block_of(left, top, side), block_of(left + 1, top, side), block_of(left, top + 1, side),
                            block_of(left + 1, top + 1, side)},
                           {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v},
                           block_of((int)(column + 0.5f), (int)(row + 0.5f), side)};
  return four;
}

// E r^2 of one map in stored units.
static inline float3 stored_between(const Maps* maps, size_t map, const DeviceSpheres* spheres,
                                    const FourTexels* four) {
  __global const uchar* const texels = maps->texels + map * texels_of_map(spheres);
  __global const ushort* const steps = maps->blocks + (ITEMS_OF_BLOCK * map + 1) * blocks_of_map(spheres);
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < 4; ++i) {
    const float step = as_float((uint)steps[four->blocks[i]] << 16),
                brightness = four->weights[i] * step * (float)texels[four->texels[i]];
#if NEPHROID_CHANNELS == 1
    sum += brightness;
#else
    const uint colour = steps[blocks_of_map(spheres) + four->blocks[i]];
    const float red = ((float)(colour & 255u) - COLOUR_ZERO) / COLOUR_STEPS,
                blue = ((float)(colour >> 8) - COLOUR_ZERO) / COLOUR_STEPS;
    sum += brightness * (float3)(red, 2.0f - 0.5f * (red + blue), blue);
#endif
  }
  return sum;
}

// E r^2 of the set whose maps begin with number `first`, in stored units.
static inline float3 stored_between_spheres(const Maps* maps, size_t first, const DeviceSpheres* spheres,
                                            const FourTexels* four, Shell shell) {
  const float3 lower = stored_between(maps, first + (size_t)shell.lower, spheres, four);
  return lower + shell.part * (stored_between(maps, first + (size_t)shell.upper, spheres, four) - lower);
}

// Row `row` of the rotation of set k of eight.
static inline float3 row_of_set(__global const DeviceEightSets* eight, int k, int row) {
  return (float3)(eight->to_bake[3 * row][k], eight->to_bake[3 * row + 1][k], eight->to_bake[3 * row + 2][k]);
}
static inline float3 in_set(__global const DeviceEightSets* eight, int k, float3 direction) {
  return (float3)(dot(row_of_set(eight, k, 0), direction), dot(row_of_set(eight, k, 1), direction),
                  dot(row_of_set(eight, k, 2), direction));
}
static inline float3 flux_of_set(__global const DeviceEightSets* eight, int k) {
  return (float3)(eight->flux[0][k], eight->flux[1][k], eight->flux[2][k]);
}

// The light of a set in a unit direction of the scene, in the set's coordinates.
typedef struct {
  float3 outwards; // the direction
  float3 way;      // the light's way in the nearest texel's block
  float3 stored;   // E r^2 in stored units, interpolated
} SetLight;

// The light of set k of eight.
static inline SetLight light_of_set(const Maps* maps, const DeviceSpheres* spheres,
                                    __global const DeviceEightSets* eight, int k, float3 direction, Shell shell) {
  SetLight light;
  light.outwards = in_set(eight, k, direction);
  const FourTexels four = four_texels(light.outwards, spheres->side);
  const size_t first = (size_t)eight->first[k],
               nearest = first + (size_t)(shell.part > 0.5f ? shell.upper : shell.lower);
  light.way =
      maps->way_of[maps->blocks[ITEMS_OF_BLOCK * nearest * blocks_of_map(spheres) + four.nearest_block]].xyz;
  light.stored = stored_between_spheres(maps, first, spheres, &four, shell);
  return light;
}

#ifdef NEPHROID_GPU
// E r^2 of all sets, linear sRGB, on a surface that lies in a unit direction from the middle and has a unit normal on
// the object's side. beyond: 0 up to the largest sphere, towards 1 far from it (spheres_eight.h). It takes one set
// after the other, because eight side by side need more registers than there are.
static inline float3 caustic_of_sets(const Maps* maps, const DeviceSpheres* spheres,
                                     __global const DeviceEightSets* sets, int eights, float3 direction, Shell shell,
                                     float beyond, float3 normal) {
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < 8 * eights; ++i) {
    __global const DeviceEightSets* eight = sets + i / 8;
    const SetLight light = light_of_set(maps, spheres, eight, i % 8, direction, shell);
    const float3 facing = -in_set(eight, i % 8, normal);
    const float radial = fmax(dot(facing, light.outwards), 0.0f);
    const float along = fmax(dot(facing, light.way), 0.0f) / fmax(fabs(dot(light.outwards, light.way)), LEAST_COSINE);
    sum += (along + beyond * (radial - along)) * flux_of_set(eight, i % 8) * light.stored;
  }
  return spheres->scale * sum;
}
#else
#include "kernels/environment/spheres_eight.h"
#endif

// Light in the air at a place: the sum over sets of E r^2 across the way of the light, not through the sphere.
typedef struct {
  float3 rgb; // linear sRGB
  float3 way; // sum of ways in the scene times luminance; shorter than rgb's luminance where light goes several ways
} AirLight;

static inline float luminance_of(float3 rgb) { return dot(rgb, (float3)(0.2126f, 0.7152f, 0.0722f)); }

// Adds the light of set k of eight in a unit direction of the scene.
static inline void add_air(AirLight* sum, const Maps* maps, const DeviceSpheres* spheres,
                           __global const DeviceEightSets* eight, int k, float3 direction, Shell shell) {
  const SetLight light = light_of_set(maps, spheres, eight, k, direction, shell);
  const float3 way = light.way;
  const float3 rgb =
      (spheres->scale / fmax(fabs(dot(light.outwards, way)), LEAST_COSINE)) * flux_of_set(eight, k) * light.stored;
  sum->rgb += rgb;
  sum->way += luminance_of(rgb) *
              (way.x * row_of_set(eight, k, 0) + way.y * row_of_set(eight, k, 1) + way.z * row_of_set(eight, k, 2));
}

// Looks up what compile_air made of all sets: [sphere][stored texel][6], in the object's coordinates.
static inline AirLight compiled_air(__global const float* air, const DeviceSpheres* spheres, float3 in_object,
                                    Shell shell) {
  const FourTexels four = four_texels(in_object, spheres->side);
  const size_t map_texels = texels_of_map(spheres);
  AirLight sum = {(float3)(0.0f), (float3)(0.0f)};
  for (int i = 0; i < 4; ++i) {
    const size_t lower = 2 * ((size_t)shell.lower * map_texels + four.texels[i]),
                 upper = 2 * ((size_t)shell.upper * map_texels + four.texels[i]);
    const float3 rgb = vload3(lower, air), way = vload3(lower + 1, air);
    sum.rgb += four.weights[i] * (rgb + shell.part * (vload3(upper, air) - rgb));
    sum.way += four.weights[i] * (way + shell.part * (vload3(upper + 1, air) - way));
  }
  return sum;
}
