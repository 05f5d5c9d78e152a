// SPDX-License-Identifier: Apache-2.0
// caustic_of_sets of spheres.h for a CPU: eight sets side by side, in its vectors.
DEFINE_STORED_PLACE(eight_stored_places, float8)

// Reads two consecutive numbers at once, the first into the lower half.
#define EIGHT_PAIRS(AS, at, offset)                                                                                    \
  (AS(vload2(0, at[0] + (offset))), AS(vload2(0, at[1] + (offset))), AS(vload2(0, at[2] + (offset))),                  \
   AS(vload2(0, at[3] + (offset))), AS(vload2(0, at[4] + (offset))), AS(vload2(0, at[5] + (offset))),                  \
   AS(vload2(0, at[6] + (offset))), AS(vload2(0, at[7] + (offset))))

// Eight values of brightness and, of 3 channels, of that times the codes of red and of blue.
typedef struct {
  float8 channels[NEPHROID_CHANNELS];
} EightCaustics;

// A row of the stored form in eight maps, from the left one of two texels on.
typedef struct {
  __global const uchar* texels[8];
  __global const ushort* steps[8]; // from the block of the left one on
  int8 crosses;                    // all bits: the right one is in the next block
} EightRows;

// Interpolates between the two texels. after: how many maps after these.
static inline EightCaustics between_columns(const EightRows* rows, const DeviceSpheres* spheres, size_t after,
                                            float8 u) {
  EightCaustics caustics;
  const uint8 both = convert_uint8((ushort8)EIGHT_PAIRS(as_ushort, rows->texels, after * texels_of_map(spheres)));
  const size_t after_blocks = after * ITEMS_OF_BLOCK * blocks_of_map(spheres);
  const uint8 steps = (uint8)EIGHT_PAIRS(as_uint, rows->steps, after_blocks);
  const float8 left = convert_float8(both & 255u) * as_float8(steps << 16),
               right = convert_float8(both >> 8) * as_float8(select(steps << 16, steps & 0xffff0000u, rows->crosses));
  caustics.channels[0] = mix(left, right, u);
#if NEPHROID_CHANNELS == 3
  const uint8 colours = (uint8)EIGHT_PAIRS(as_uint, rows->steps, after_blocks + blocks_of_map(spheres));
  const uint8 colours_right = select(colours, colours >> 16, rows->crosses);
  caustics.channels[1] =
      mix(left * convert_float8(colours & 255u), right * convert_float8(colours_right & 255u), u);
  caustics.channels[2] =
      mix(left * convert_float8(colours >> 8 & 255u), right * convert_float8(colours_right >> 8 & 255u), u);
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
// direction from the middle and the surface's normal, in each set's coordinates. blocks: those of the maps' nearest
// texels, which have the way of the light. map: its number among those of a direction. beyond: 0 up to the largest
// sphere, towards 1 far from it, where all light seems to come from the middle. It mixes the factor by the light's way
// with that by the direction from the middle.
static inline float8 eight_factors(const Maps* maps, const DeviceSpheres* spheres,
                                   __global const DeviceEightSets* eight, size_t map, int8 blocks, float8 x, float8 y,
                                   float8 z, float8 normal_x, float8 normal_y, float8 normal_z, float beyond) {
  const size_t map_items = ITEMS_OF_BLOCK * blocks_of_map(spheres);
  int block[8];
  vstore8(blocks, 0, block);
  float ways[3][8];
  for (int k = 0; k < 8; ++k) {
    const float4 way = maps->way_of[maps->blocks[(eight->first[k] + map) * map_items + (size_t)block[k]]];
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
  const int stride = spheres->side + 2, blocks_across = BLOCKS_ACROSS(spheres->side);
  const size_t map_texels = texels_of_map(spheres), lower = (size_t)shell.lower, upper = (size_t)shell.upper;
  float8 red = 0.0f, green = 0.0f, blue = 0.0f;
  for (int i = 0; i < eights; ++i) {
    __global const DeviceEightSets* eight = sets + i;
    const float8 x = row_of_eight(eight, 0, direction), y = row_of_eight(eight, 1, direction),
                 z = row_of_eight(eight, 2, direction);
    float8 columns, rows;
    eight_stored_places(x, y, z, (float)spheres->side, &columns, &rows);
    const int8 left = convert_int8(columns), top = convert_int8(rows);
    const float8 u = columns - convert_float8(left), v = rows - convert_float8(top);
    int first[8], first_above[8], first_below[8];
    vstore8(top * stride + left, 0, first);
    vstore8((top >> BLOCK_DOWN_BITS) * blocks_across + (left >> BLOCK_ACROSS_BITS), 0, first_above);
    vstore8(((top + 1) >> BLOCK_DOWN_BITS) * blocks_across + (left >> BLOCK_ACROSS_BITS), 0, first_below);
    EightRows above, below;
    for (int k = 0; k < 8; ++k) {
      above.texels[k] = maps->texels + map_texels * eight->first[k] + first[k];
      below.texels[k] = above.texels[k] + stride;
      __global const ushort* const steps =
          maps->blocks + (ITEMS_OF_BLOCK * eight->first[k] + 1) * blocks_of_map(spheres);
      above.steps[k] = steps + first_above[k];
      below.steps[k] = steps + first_below[k];
    }
    above.crosses = below.crosses = (left >> BLOCK_ACROSS_BITS) != ((left + 1) >> BLOCK_ACROSS_BITS);
    EightCaustics caustics =
        eight_between(between_columns(&above, spheres, lower, u), between_columns(&below, spheres, lower, u), v);
    if (shell.part > 0.0f)
      caustics = eight_between(
          caustics,
          eight_between(between_columns(&above, spheres, upper, u), between_columns(&below, spheres, upper, u), v),
          (float8)(shell.part));
    const int8 nearest = (convert_int8(rows + 0.5f) >> BLOCK_DOWN_BITS) * blocks_across +
                         (convert_int8(columns + 0.5f) >> BLOCK_ACROSS_BITS);
    const float8 factors =
        eight_factors(maps, spheres, eight, shell.part > 0.5f ? upper : lower, nearest, x, y, z,
                      row_of_eight(eight, 0, normal), row_of_eight(eight, 1, normal), row_of_eight(eight, 2, normal),
                      beyond);
    const float8 light = factors * caustics.channels[0];
#if NEPHROID_CHANNELS == 1
    red += light * vload8(0, eight->flux[0]);
    green += light * vload8(0, eight->flux[1]);
    blue += light * vload8(0, eight->flux[2]);
#else
    const float8 light_red = (factors * caustics.channels[1] - COLOUR_ZERO * light) / COLOUR_STEPS,
                 light_blue = (factors * caustics.channels[2] - COLOUR_ZERO * light) / COLOUR_STEPS;
    red += light_red * vload8(0, eight->flux[0]);
    green += (2.0f * light - 0.5f * (light_red + light_blue)) * vload8(0, eight->flux[1]);
    blue += light_blue * vload8(0, eight->flux[2]);
#endif
  }
  return spheres->scale * (float3)(sum_of_eight(red), sum_of_eight(green), sum_of_eight(blue));
}
