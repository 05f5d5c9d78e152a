// SPDX-License-Identifier: Apache-2.0
// Photons leave a light mostly where earlier ones have mattered. The three numbers that give a photon's direction
// (targets.h: target and place in it) are drawn from a histogram over [0, 1)^3 instead of evenly. A photon counts for
// less as it comes more often (importance sampling in the space of random numbers, as in Lepage 1978, "A new algorithm
// for adaptive multidimensional integration"). app/photons/effort/emitters.h says how the histogram is learned.
#include "kernels/tracing/random.h"
#include "kernels/tracing/shared_types.h"

typedef struct {
  float density; // how much more often than evenly: the photon counts 1 / density
  uint cell;     // cell of the histogram
} Guided;

// Returns one of `count` bins, and in *number, in [0, 1), a place in it. cdf: exact_cdf of the bins.
static inline int draw_bin(__global const float* cdf, int count, float* number, float* density) {
  const int bin = choose(cdf, count, *number);
  const float before = chance_before(cdf, bin), chance = cdf[bin] - before;
  const float moved = ((float)bin + (*number - before) / chance) / (float)count;
  *number = moved < 0x1.fffffep-1f ? moved : 0x1.fffffep-1f;
  *density *= chance * (float)count;
  return bin;
}

// numbers: xyz of a photon's emission. guide: the light's cdfs of the first number, of the second, of the third.
static inline Guided guide_numbers(__global const float* guide, float4* numbers) {
  Guided guided = {1.0f, 0u};
  float3 moved = numbers->xyz;
  float number = moved.x;
  const int i = draw_bin(guide, GUIDE_BINS_X, &number, &guided.density);
  moved.x = number;
  number = moved.y;
  const int j =
      i * GUIDE_BINS_Y + draw_bin(guide + GUIDE_BINS_X + i * GUIDE_BINS_Y, GUIDE_BINS_Y, &number, &guided.density);
  moved.y = number;
  number = moved.z;
  const int k = draw_bin(guide + GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + j * GUIDE_BINS_Z, GUIDE_BINS_Z, &number,
                         &guided.density);
  moved.z = number;
  numbers->xyz = moved;
  guided.cell = (uint)(j * GUIDE_BINS_Z + k);
  return guided;
}
