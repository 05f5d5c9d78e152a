// SPDX-License-Identifier: Apache-2.0
// caustic_of_sets of spheres.h for a CPU: eight sets side by side, in its vectors.
DEFINE_STORED_PLACE(eight_stored_places, float8)

// Reads two consecutive stored numbers at once, the first into the lower half.
#define EIGHT_PAIRS(at, offset)                                                                                        \
  (uint8)(as_uint(vload2(0, at[0] + (offset))), as_uint(vload2(0, at[1] + (offset))),                                  \
          as_uint(vload2(0, at[2] + (offset))), as_uint(vload2(0, at[3] + (offset))),                                  \
          as_uint(vload2(0, at[4] + (offset))), as_uint(vload2(0, at[5] + (offset))),                                  \
          as_uint(vload2(0, at[6] + (offset))), as_uint(vload2(0, at[7] + (offset))))
static inline float8 first_of(uint8 pairs) { return as_float8(pairs << 16); }
static inline float8 second_of(uint8 pairs) { return as_float8(pairs & 0xffff0000u); }

// Eight values of each channel.
typedef struct {
  float8 channels[NEPHROID_CHANNELS];
} EightCaustics;

// Interpolates between two neighbouring texels, `offset` numbers after each of eight places.
static inline EightCaustics between_columns(__global const ushort* const* at, size_t offset, float8 u) {
  EightCaustics caustics;
#if NEPHROID_CHANNELS == 1
  const uint8 both = EIGHT_PAIRS(at, offset);
  caustics.channels[0] = mix(first_of(both), second_of(both), u);
#else
  const uint8 red_green = EIGHT_PAIRS(at, offset), blue_red = EIGHT_PAIRS(at, offset + 2),
              green_blue = EIGHT_PAIRS(at, offset + 4);
  caustics.channels[0] = mix(first_of(red_green), second_of(blue_red), u);
  caustics.channels[1] = mix(second_of(red_green), first_of(green_blue), u);
  caustics.channels[2] = mix(first_of(blue_red), second_of(green_blue), u);
#endif
  return caustics;
}

static inline EightCaustics eight_between(EightCaustics a, EightCaustics b, float8 part) {
  for (int c = 0; c < NEPHROID_CHANNELS; ++c) a.channels[c] = mix(a.channels[c], b.channels[c], part);
  return a;
}

static inline float sum_of_eight(float8 v) {
  const float4 four = v.lo + v.hi;
  const float2 two = four.lo + four.hi;
  return two.x + two.y;
}

static inline float8 row_of_eight(__global const DeviceEightSets* eight, int row, float3 direction) {
  return vload8(3 * row, eight->to_bake[0]) * direction.x + vload8(3 * row + 1, eight->to_bake[0]) * direction.y +
         vload8(3 * row + 2, eight->to_bake[0]) * direction.z;
}

// For eight sets, E on a surface over E on the sphere, which faces the middle. x, y, z and normal_x, y, z: the
// direction from the middle and the surface's normal, in each set's coordinates. texels: the nearest texels of the
// maps, which have the way of the light. beyond: 0 up to the largest sphere, towards 1 far from it, where all light
// seems to come from the middle. It mixes the factor by the light's way with that by the direction from the middle.
static inline float8 eight_factors(const Maps* maps, __global const DeviceEightSets* eight, size_t map, int8 texels,
                                   float8 x, float8 y, float8 z, float8 normal_x, float8 normal_y, float8 normal_z,
                                   float beyond) {
  int texel[8];
  vstore8(texels, 0, texel);
  float ways[3][8];
  for (int k = 0; k < 8; ++k) {
    const float4 way = maps->way_of[maps->ways[eight->first[k] + map + (size_t)texel[k]]];
    ways[0][k] = way.x;
    ways[1][k] = way.y;
    ways[2][k] = way.z;
  }
  const float8 way_x = vload8(0, ways[0]), way_y = vload8(0, ways[1]), way_z = vload8(0, ways[2]);
  const float8 radial = fmax(-(normal_x * x + normal_y * y + normal_z * z), 0.0f);
  const float8 along = fmax(-(normal_x * way_x + normal_y * way_y + normal_z * way_z), 0.0f) /
                       fmax(fabs(x * way_x + y * way_y + z * way_z), LEAST_COSINE);
  return along + beyond * (radial - along);
}

// E r^2 of all sets, linear sRGB, on a surface in a unit direction from the middle. beyond: as in eight_factors.
static inline float3 caustic_of_sets(const Maps* maps, const DeviceSpheres* spheres,
                                     __global const DeviceEightSets* sets, int eights, float3 direction, Shell shell,
                                     float beyond, float3 normal) {
  const int stride = spheres->side + 2;
  const size_t row_items = (size_t)stride * NEPHROID_CHANNELS, map_texels = (size_t)(stride * stride);
  const size_t lower = (size_t)shell.lower * map_texels, upper = (size_t)shell.upper * map_texels;
  float8 red = 0.0f, green = 0.0f, blue = 0.0f;
  for (int i = 0; i < eights; ++i) {
    __global const DeviceEightSets* eight = sets + i;
    const float8 x = row_of_eight(eight, 0, direction), y = row_of_eight(eight, 1, direction),
                 z = row_of_eight(eight, 2, direction);
    float8 columns, rows;
    eight_stored_places(x, y, z, (float)spheres->side, &columns, &rows);
    const int8 left = convert_int8(columns), top = convert_int8(rows);
    const float8 u = columns - convert_float8(left), v = rows - convert_float8(top);
    const int8 texels = NEPHROID_CHANNELS * (top * stride + left);
    __global const ushort* const stored = maps->stored;
    __global const ushort* const at[8] = {stored + NEPHROID_CHANNELS * eight->first[0] + texels.s0,
                                          stored + NEPHROID_CHANNELS * eight->first[1] + texels.s1,
                                          stored + NEPHROID_CHANNELS * eight->first[2] + texels.s2,
                                          stored + NEPHROID_CHANNELS * eight->first[3] + texels.s3,
                                          stored + NEPHROID_CHANNELS * eight->first[4] + texels.s4,
                                          stored + NEPHROID_CHANNELS * eight->first[5] + texels.s5,
                                          stored + NEPHROID_CHANNELS * eight->first[6] + texels.s6,
                                          stored + NEPHROID_CHANNELS * eight->first[7] + texels.s7};
    const size_t low = NEPHROID_CHANNELS * lower, high = NEPHROID_CHANNELS * upper;
    EightCaustics caustics = eight_between(between_columns(at, low, u), between_columns(at, low + row_items, u), v);
    if (shell.part > 0.0f)
      caustics = eight_between(caustics,
                               eight_between(between_columns(at, high, u), between_columns(at, high + row_items, u), v),
                               (float8)(shell.part));
    const int8 nearest = convert_int8(rows + 0.5f) * stride + convert_int8(columns + 0.5f);
    const float8 factors =
        eight_factors(maps, eight, shell.part > 0.5f ? upper : lower, nearest, x, y, z, row_of_eight(eight, 0, normal),
                      row_of_eight(eight, 1, normal), row_of_eight(eight, 2, normal), beyond);
    red += factors * vload8(0, eight->flux[0]) * caustics.channels[0];
    green += factors * vload8(0, eight->flux[1]) * caustics.channels[NEPHROID_CHANNELS == 3 ? 1 : 0];
    blue += factors * vload8(0, eight->flux[2]) * caustics.channels[NEPHROID_CHANNELS == 3 ? 2 : 0];
  }
  return spheres->scale * (float3)(sum_of_eight(red), sum_of_eight(green), sum_of_eight(blue));
}
