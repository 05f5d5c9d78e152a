// SPDX-License-Identifier: Apache-2.0
// Sorts photons into the buckets of photon_map.h: count_photons, sum_blocks, scan_blocks, then scatter_photons.
#include "kernels/photons/photon_map.h"
#include "kernels/tracing/work_item.h"

// The number of blocks in which the buckets are added up, one a work item.
#ifndef NEPHROID_SCAN_BLOCKS
#define NEPHROID_SCAN_BLOCKS 256
#endif

static inline uint photon_bucket(const StoredPhoton* photon, int3 cell, uint mask) {
  return grid_block_bucket(photon->group, cell.x >> GRID_BLOCK_BITS, cell.y, cell.z, mask) +
         (uint)(cell.x & (GRID_BLOCK - 1));
}

static inline int3 cell_of_photon(const StoredPhoton* photon, float inverse_cell) {
  return grid_cell((float3)(photon->position[0], photon->position[1], photon->position[2]), inverse_cell);
}

// The number of buckets, bucket_mask + GRID_BLOCK: the last block goes beyond the mask.
static inline uint bucket_count(PhotonGrid grid) { return grid.bucket_mask + GRID_BLOCK; }

// counts: [bucket + 1], zero before.
kernel void count_photons(global const StoredPhoton* stored, volatile global uint* counts, PhotonGrid grid, uint slots)
{
  const uint i = work_item();
  if (i >= slots) return;
  const StoredPhoton photon = stored[i];
  if (photon.group == NO_PHOTON) return;
  atomic_inc(counts + photon_bucket(&photon, cell_of_photon(&photon, grid.inverse_cell), grid.bucket_mask));
}

kernel void sum_blocks(global const uint* counts, global uint* sums, PhotonGrid grid) {
  const uint block = work_item(), buckets = bucket_count(grid), length = buckets / NEPHROID_SCAN_BLOCKS + 1u;
  if (block >= NEPHROID_SCAN_BLOCKS) return;
  const uint first = min(block * length, buckets), last = min(first + length, buckets);
  uint sum = 0;
  for (uint i = first; i < last; ++i) sum += counts[i];
  sums[block] = sum;
}

// Turns counts into the ends of buckets.
kernel void scan_blocks(global uint* counts, global const uint* sums, PhotonGrid grid) {
  const uint block = work_item(), buckets = bucket_count(grid), length = buckets / NEPHROID_SCAN_BLOCKS + 1u;
  if (block >= NEPHROID_SCAN_BLOCKS) return;
  const uint first = min(block * length, buckets), last = min(first + length, buckets);
  uint sum = 0;
  for (uint b = 0; b < block; ++b) sum += sums[b];
  for (uint i = first; i < last; ++i) {
    sum += counts[i];
    counts[i] = sum;
  }
  if (block == NEPHROID_SCAN_BLOCKS - 1) counts[buckets] = sum;
}

// Turns the buckets' ends into their starts. No key matches the eight photons beyond the last.
kernel void scatter_photons(global const StoredPhoton* stored, volatile global uint* ends, global float* positions,
                            global int* values, PhotonGrid grid, uint slots) {
  const uint i = work_item();
  if (i < 8) values[ends[bucket_count(grid)] + i] = NO_PHOTON;
  if (i >= slots) return;
  const StoredPhoton photon = stored[i];
  if (photon.group == NO_PHOTON) return;
  const int3 cell = cell_of_photon(&photon, grid.inverse_cell);
  const uint j = atomic_dec(ends + photon_bucket(&photon, cell, grid.bucket_mask)) - 1u;
  positions[j] = photon.position[0];
  positions[grid.stride + j] = photon.position[1];
  positions[2 * grid.stride + j] = photon.position[2];
  values[j] = grid_key(photon.group, cell.x >> GRID_BLOCK_BITS, cell.y, cell.z);
  values[grid.stride + j] = photon.xyz[0];
  values[2 * grid.stride + j] = photon.xyz[1];
  values[3 * grid.stride + j] = photon.xyz[2];
}
