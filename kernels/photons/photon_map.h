// SPDX-License-Identifier: Apache-2.0
// A hash grid over photons on surfaces, and the sum over those near a point.
//
// The grid has no bounds. Space is cut into cubic cells, and a row of cells along x into blocks of 32. The bucket of
// cell (ix, iy, iz) of a group is hash(group, ix / 32, iy, iz) + ix % 32. The cells of a block are thus neighbours in
// memory, so a search reads a row as one run of sorted photons, or as two. Cells that share buckets by accident differ
// in their photons' key: the group and the low bits of block and row. As long as a search spans fewer blocks and rows
// than those bits count, no two of its runs look for the same key, so no photon counts twice, and a run may read beyond
// its end. Photons with the same key from elsewhere are too far away.
//
// Powers are whole quanta, so a sum does not depend on a bucket's order, which atomic operations decide.
#include "kernels/photons/photon_map_types.h"
#include "kernels/tracing/registers.h"

// A search may span this many rows each way, so its radius may be up to 3 cells.
#define GRID_ROWS 8
#define GRID_KEY_BITS 7 // one for the block, three for each coordinate of the row

// The group of light on one side of an object's surface: light leaks neither to other objects nor through a sheet.
static inline int photon_group(int object, bool front, int cluster, int object_count) {
  return (cluster * object_count + object) * 2 + (front ? 1 : 0);
}

static inline int3 grid_cell(float3 position, float inverse_cell) {
  return convert_int3_sat_rtn(position * inverse_cell);
}

// The first bucket of a block of cells. The finalizer of MurmurHash3 (Appleby 2011) mixes odd multiples.
static inline uint grid_block_bucket(int group, int block, int iy, int iz, uint mask) {
  uint h = (uint)group * 0x9E3779B1u ^ (uint)block * 0x27D4EB2Fu ^ (uint)iy * 0x85EBCA77u ^ (uint)iz * 0xC2B2AE3Du;
  h = (h ^ h >> 16) * 0x85EBCA6Bu;
  h = (h ^ h >> 13) * 0xC2B2AE35u;
  return (h ^ h >> 16) & mask;
}

static inline int grid_key(int group, int block, int iy, int iz) {
  return group << GRID_KEY_BITS | (block & 1) << 6 | (iy & (GRID_ROWS - 1)) << 3 | (iz & (GRID_ROWS - 1));
}

// Sorted photons: arrays of x, of y and of z, one after the other, and likewise of key, X, Y, Z. starts[b] is the first
// photon of bucket b; there is one more at the end.
typedef struct {
  __global const uint* starts;
  __global const float* positions;
  __global const int* values;
  PhotonGrid grid;
} PhotonMap;

#define PHOTON_MAP_ARGUMENTS                                                                                           \
  __global const uint *starts, __global const float *sorted_positions, __global const int *sorted_values,              \
      PhotonGrid grid
#define PHOTON_MAP {starts, sorted_positions, sorted_values, grid}

typedef struct {
  long3 xyz; // quanta
  uint count;
} Gathered;

// What a search looks for, and its sums so far: in int for each of 8 lanes, for as many steps as fit, then in long.
typedef struct {
  float3 position, tilt; // tilt: the normal times 4
  float radius2;
  int8 x, y, z, count;
  uint steps;
  Gathered sum;
} Gathering;

// 127 steps of PHOTON_LIMIT quanta stay below 2^31.
#define GATHER_STEPS 127u

static inline int sum_of_lanes(int8 v) {
  const int4 sum = v.lo + v.hi;
  return sum.x + sum.y + sum.z + sum.w;
}

static inline long long_sum_of_lanes(int8 v) {
  const long4 sum = convert_long4(v.lo) + convert_long4(v.hi); // no long8: the compiler warns where it fits no register
  return sum.x + sum.y + sum.z + sum.w;
}

static inline void settle(Gathering* g) {
  g->sum.xyz += (long3)(long_sum_of_lanes(g->x), long_sum_of_lanes(g->y), long_sum_of_lanes(g->z));
  g->sum.count -= (uint)sum_of_lanes(g->count); // a lane that is true is -1
  g->x = g->y = g->z = g->count = (int8)(0);
  g->steps = 0;
}

// Adds the photons from `begin` to `end`, or a few more, that have the key and lie near the point.
static inline void gather_run(const PhotonMap* map, uint begin, uint end, int key, Gathering* g) {
  const uint stride = map->grid.stride;
  while (begin < end) {
    const uint stop = min(end, begin + 8 * (GATHER_STEPS - g->steps));
    g->steps += (stop - begin + 7) / 8;
    int8 sum_x = g->x, sum_y = g->y, sum_z = g->z, count = g->count;
    for (; begin < stop; begin += 8) {
      const float8 dx = vload8(0, map->positions + begin) - g->position.x;
      const float8 dy = vload8(0, map->positions + stride + begin) - g->position.y;
      const float8 dz = vload8(0, map->positions + 2 * stride + begin) - g->position.z;
      const float8 tilted = dx * g->tilt.x + dy * g->tilt.y + dz * g->tilt.z;
      const int8 near =
          (dx * dx + dy * dy + dz * dz + tilted * tilted < g->radius2) & (vload8(0, map->values + begin) == key);
      sum_x += vload8(0, map->values + stride + begin) & near;
      sum_y += vload8(0, map->values + 2 * stride + begin) & near;
      sum_z += vload8(0, map->values + 3 * stride + begin) & near;
      count += near;
    }
    g->x = sum_x;
    g->y = sum_y;
    g->z = sum_z;
    g->count = count;
    if (g->steps == GATHER_STEPS) settle(g);
  }
}

// Adds up the photons of a group in a flat spheroid about a point of a surface, d^2 + 16 (d . n)^2 < r^2. It is as wide
// as the radius in the tangent plane and a quarter of that along the normal, so that light around an object's corner
// does not count. radius: at most 3 cells. The kernel is constant: photons count in full.
COMPILED_ONCE Gathered gather_photons(const PhotonMap* map, float3 position, float3 normal, int group, float radius) {
  Gathering g;
  g.position = position;
  g.tilt = 4.0f * normal;
  g.radius2 = radius * radius;
  g.x = g.y = g.z = g.count = (int8)(0);
  g.steps = 0;
  g.sum.xyz = (long3)(0);
  g.sum.count = 0;
  // The spheroid's bounding box: with M = 1 + 16 n n^T it is d^T M d < r^2, and reaches r sqrt((M^-1)_aa) along axis a.
  // It is enlarged a little, so that it holds every photon that passes the test, whatever the rounding: what a run
  // reads beyond its cells never counts.
  const float3 reach = radius * 1.000001f * sqrt(1.0f - 16.0f / 17.0f * normal * normal) + fabs(position) * 0x1p-22f;
  const int3 low = grid_cell(position - reach, map->grid.inverse_cell),
             high = grid_cell(position + reach, map->grid.inverse_cell);
  const int rows_y = min(high.y - low.y, GRID_ROWS - 1), rows_z = min(high.z - low.z, GRID_ROWS - 1);
  const int first_block = low.x >> GRID_BLOCK_BITS, blocks = min((high.x >> GRID_BLOCK_BITS) - first_block, 1);
  for (int k = 0; k <= rows_z; ++k)
    for (int j = 0; j <= rows_y; ++j)
      for (int b = 0; b <= blocks; ++b) {
        const int block = first_block + b, iy = low.y + j, iz = low.z + k;
        const uint bucket = grid_block_bucket(group, block, iy, iz, map->grid.bucket_mask);
        const uint first = b == 0 ? low.x & (GRID_BLOCK - 1) : 0,
                   last = b == blocks ? high.x & (GRID_BLOCK - 1) : GRID_BLOCK - 1;
        gather_run(map, map->starts[bucket + first], map->starts[bucket + last + 1], grid_key(group, block, iy, iz),
                   &g);
      }
  settle(&g);
  return g.sum;
}
