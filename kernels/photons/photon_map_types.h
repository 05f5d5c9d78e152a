// SPDX-License-Identifier: Apache-2.0
// Structs of photon maps that the host and kernels share. Lengths are in scene units.
#ifndef NEPHROID_PHOTON_MAP_TYPES_H
#define NEPHROID_PHOTON_MAP_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// A group is the side of an object's surface and the cluster of its light (photon_group in photon_map.h), below 2^24.
#define NO_PHOTON (-1)
#define MAX_PHOTON_GROUPS (1 << 24)

// A photon on a diffuse surface, in the slot that has its number.
typedef struct {
  float position[3];
  int group;  // NO_PHOTON: the slot is empty
  int xyz[3]; // reflected power in quanta, 0..PHOTON_LIMIT
  int padding;
} StoredPhoton;

// The most quanta that a photon may carry; 127 photons' still fit into an int.
#define PHOTON_LIMIT 0x1p24f

// Cells in a block of the hash grid: photon_map.h says what blocks are.
#define GRID_BLOCK_BITS 5
#define GRID_BLOCK (1 << GRID_BLOCK_BITS)

typedef struct {
  float inverse_cell; // 1 / edge of a cell
  uint bucket_mask;   // 2^k - 1; there are GRID_BLOCK - 1 more buckets
  uint stride;        // between the arrays of sorted photons: at least their number + 8
} PhotonGrid;

// Where a path from the eye meets a diffuse surface.
typedef struct {
  float4 position;
  float4 normal;     // unit, of the triangle
  float4 throughput; // X, Y, Z: what a radiance of 1 there adds to the pixel
  int group;         // NO_PHOTON: the path met none
  int padding[3];
} VisiblePoint;

// The statistics of a pixel in one cluster for progressive photon mapping.
typedef struct {
  float radius2;
  float count;   // photons, of which each iteration keeps a fraction alpha
  float flux[3]; // XYZ in power units, of the photons within the radius
} PixelStatistics;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(StoredPhoton) == 32 && sizeof(PhotonGrid) == 12 && sizeof(VisiblePoint) == 64 &&
              sizeof(PixelStatistics) == 20);
} // namespace nephroid::shared
#endif

#endif
