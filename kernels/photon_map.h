// SPDX-License-Identifier: Apache-2.0
// A hash grid over photons on surfaces, and the sum over those within a radius of a point.
//
// The grid has no bounds. Space is cut into cubic cells; cell (ix, iy, iz) of a group has the bucket hash(group, iy, iz) + ix, modulo the
// number of buckets, so the cells of a row along x are neighbours in memory too, and a row is read as one run of sorted photons.
// What shares a bucket by accident is told apart by a photon's key, its group and the low bits of its row (iy, iz): as
// long as a search spans fewer rows than those bits count, no photon is met twice with a key that fits. Photons with the same
// key from elsewhere are too far away.
//
// Powers are whole numbers of quanta, so a sum does not depend on the order in which photons of a bucket were sorted, which is that of
// atomic operations.
#ifndef NEPHROID_PHOTON_MAP_H
#define NEPHROID_PHOTON_MAP_H

#include "photon_map_types.h"

// A search may span this many rows each way: the radius may be up to 3 cells.
#define GRID_ROWS 8
#define GRID_ROW_BITS 3

// The side of an object's surface that light in `cluster` arrives at: light does not leak to other objects or through a sheet.
static inline int photon_group(int object, bool front, int cluster, int object_count)
{
  return (cluster * object_count + object) * 2 + (front ? 1 : 0);
}

static inline int3 grid_cell(float3 position, float inverse_cell) { return convert_int3_sat_rtn(position * inverse_cell); }

// The bucket of ix = 0 of a row, before the modulus. The finalizer of MurmurHash3 (Appleby 2011) mixes three odd multiples.
static inline uint grid_row_bucket(int group, int iy, int iz)
{
  uint h = (uint)group * 0x9E3779B1u ^ (uint)iy * 0x85EBCA77u ^ (uint)iz * 0xC2B2AE3Du;
  h = (h ^ h >> 16) * 0x85EBCA6Bu;
  h = (h ^ h >> 13) * 0xC2B2AE35u;
  return h ^ h >> 16;
}

static inline int grid_key(int group, int iy, int iz)
{
  return group << 2 * GRID_ROW_BITS | (iy & (GRID_ROWS - 1)) << GRID_ROW_BITS | (iz & (GRID_ROWS - 1));
}

// Sorted photons: x, y, z one array after the other, and so key, X, Y, Z. starts[b] is the first photon of bucket b; one more at the end.
typedef struct {
  __global const uint* starts;
  __global const float* positions;
  __global const int* values;
  PhotonGrid grid;
} PhotonMap;

typedef struct {
  long3 xyz; // quanta
  uint count;
} Gathered;

// What is looked for, and the sums so far: of each lane of 8, over at most 64 steps in int, then in long.
typedef struct {
  float3 position, normal;
  float radius2, height; // of the flat cylinder about the point that counts
  int8 x, y, z, count;
  int steps;
  Gathered sum;
} Gathering;

static inline int sum_of_lanes(int8 v)
{
  const int4 half = v.lo + v.hi;
  return half.x + half.y + half.z + half.w;
}

static inline long long_sum_of_lanes(int8 v)
{
  const long8 wide = convert_long8(v);
  const long4 half = wide.lo + wide.hi;
  return half.x + half.y + half.z + half.w;
}

static inline void settle(Gathering* g)
{
  g->sum.xyz += (long3)(long_sum_of_lanes(g->x), long_sum_of_lanes(g->y), long_sum_of_lanes(g->z));
  g->sum.count -= (uint)sum_of_lanes(g->count); // a lane that is true is -1
  g->x = g->y = g->z = g->count = (int8)(0);
  g->steps = 0;
}

// Adds the photons begin .. end - 1 that have the key and lie in the cylinder.
static inline void gather_run(const PhotonMap* map, uint begin, uint end, int key, Gathering* g)
{
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const uint stride = map->grid.stride;
  for (uint j = begin; j < end; j += 8) {
    const float8 dx = vload8(0, map->positions + j) - g->position.x;
    const float8 dy = vload8(0, map->positions + stride + j) - g->position.y;
    const float8 dz = vload8(0, map->positions + 2 * stride + j) - g->position.z;
    const float8 height = fabs(dx * g->normal.x + dy * g->normal.y + dz * g->normal.z);
    const int8 inside = (dx * dx + dy * dy + dz * dz < g->radius2) & (height < g->height) & (vload8(0, map->values + j) == key) &
                        (lane < (int)(end - j));
    g->x += vload8(0, map->values + stride + j) & inside;
    g->y += vload8(0, map->values + 2 * stride + j) & inside;
    g->z += vload8(0, map->values + 3 * stride + j) & inside;
    g->count += inside;
    if (++g->steps == 64) settle(g);
  }
}

// The photons of a group within a radius of a point of a surface, and within a quarter of that of its tangent plane, so that what
// lies around an object's corner does not count. radius: at most 3 cells. The kernel is constant: photons count in full.
static inline Gathered gather_photons(const PhotonMap* map, float3 position, float3 normal, int group, float radius)
{
  Gathering g;
  g.position = position;
  g.normal = normal;
  g.radius2 = radius * radius;
  g.height = 0.25f * radius;
  g.x = g.y = g.z = g.count = (int8)(0);
  g.steps = 0;
  g.sum.xyz = (long3)(0);
  g.sum.count = 0;
  const int3 low = grid_cell(position - radius, map->grid.inverse_cell), high = grid_cell(position + radius, map->grid.inverse_cell);
  const uint buckets = map->grid.bucket_mask + 1u;
  const uint cells = min((uint)(high.x - low.x) + 1u, buckets);
  const int rows_y = min(high.y - low.y, GRID_ROWS - 1), rows_z = min(high.z - low.z, GRID_ROWS - 1);
  for (int k = 0; k <= rows_z; ++k)
    for (int j = 0; j <= rows_y; ++j) {
      const int iy = low.y + j, iz = low.z + k, key = grid_key(group, iy, iz);
      const uint first = (grid_row_bucket(group, iy, iz) + (uint)low.x) & map->grid.bucket_mask, last = first + cells;
      gather_run(map, map->starts[first], map->starts[min(last, buckets)], key, &g);
      if (last > buckets) gather_run(map, map->starts[0], map->starts[last - buckets], key, &g);
    }
  settle(&g);
  return g.sum;
}

#endif
