// SPDX-License-Identifier: Apache-2.0
// Structs that app/gems writes and its kernel reads. Lengths are in scene units, directions are the stone's.
#ifndef NEPHROID_GEM_TYPES_H
#define NEPHROID_GEM_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// Sums of a pixel over its samples. A sample that meets the stone has light of 1 to send back.
#define GEM_HITS 0     // samples that meet the stone
#define GEM_ISO 1      // light that leaves above the horizon
#define GEM_COS 2      // the same, times the cosine from the zenith
#define GEM_HEAD 3     // the part of GEM_ISO that passes the head
#define GEM_BELOW 4    // light that leaves below the horizon
#define GEM_LOST 5     // light that met too many surfaces
#define GEM_SPREAD 6   // of the light of GEM_ISO whose lines all leave: times the angle between C and F, in radians
#define GEM_SPREADS 7  // the light of GEM_SPREAD, without the angle
#define GEM_WINDOW 8   // samples that see more than half of their light straight through, below the horizon
#define GEM_DARK 9     // samples that get more than half of it from where the head is
#define GEM_SUMS 10

// Sums of a pixel in two views.
#define GEM_PAIRS 0  // samples that meet the stone in both
#define GEM_CHANGE 1 // by how much GEM_HEAD differs
#define GEM_CHANGE_SUMS 2

#define GEM_COLOUR_SUMS 4 // X, Y, Z; GEM_HITS

// A parallel view of the stone.
typedef struct {
  float4 right, up, eye; // unit; eye: from the stone to the eye, where the zenith is
  float4 middle;         // of the picture, in the stone; w: half of the picture's side, and of the eye's distance
} DeviceGemView;

typedef struct {
  float n, n_c, n_f; // indices of refraction at Fraunhofer's lines d, C and F
  float loss;        // exp(-loss s) of the light is left after s
  float cos_head;    // of the half angle of the head's shadow
  int root;          // of the tree
  int side;          // of the picture, in pixels
  int samples;       // of a pixel
  uint first;        // number of its first sample
  uint2 seed;
} DeviceGem;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceGemView) == 64 && sizeof(DeviceGem) == 48);
} // namespace nephroid::shared
#endif

#endif
