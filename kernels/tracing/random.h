// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
// A number is a function of (seed, stream, iteration, index, dimension) alone, not of threads, devices or resuming.
#include "kernels/tracing/registers.h"

// Streams separate numbers for different purposes with the same (iteration, index, dimension). No two kernels of a run
// share one but for the places in a pixel, which all take from STREAM_CAMERA (eye_path.h); the kernels of relighting
// (relight_*.cl) use the streams of the kernels that they replace.
#define STREAM_PHOTONS 0u                // photons.cl: index is the photon of a pass
#define STREAM_CAMERA 1u                 // direct.cl, here and below: index is the pixel
#define STREAM_CAMERA_LIGHT 2u           // places on area lights
#define STREAM_CAMERA_CLUSTER 3u         // where a pixel starts among the clusters
#define STREAM_CAMERA_WAVELENGTH 4u      // a wavelength of a cluster
#define STREAM_SOBOL 5u                  // low_discrepancy.h: how a sequence is scrambled
#define STREAM_BACKGROUND 14u            // background.cl: index is the pixel
#define STREAM_BACKGROUND_WAVELENGTH 15u // where a pixel starts in the spectrum
#define STREAM_INDIRECT_PHOTONS 16u      // indirect_photons.cl: index is the photon of a pass
#define STREAM_PEAKS 17u                 // piece.h: index is the pixel
#define STREAM_EVEN_SKY 18u              // even_sky.cl, here and below: index is the pixel
#define STREAM_EVEN_SKY_BOUNCE 19u
#define STREAM_EVEN_SKY_CLUSTER 20u
#define STREAM_INDIRECT 22u              // indirect.cl, here and below: index is the pixel
#define STREAM_INDIRECT_BAND 23u         // where a pixel starts in the spectrum
#define STREAM_SURVEY 24u                // relight_direct.cl, its survey: index is the pixel
#define STREAM_LENS 25u                  // places on the lens: index is the photon
#define STREAM_VIEW 32u                  // view.cl, here and below: index is the pixel
#define STREAM_PASS_BAND 34u             // pass_band.h: index is the cluster
#define STREAM_BAKE 48u                  // environment/bake.cl: iteration is the direction, index the photon
#define STREAM_SEE 49u                   // environment/see.cl, here and below: index is the pixel
#define STREAM_SEE_WAVELENGTH 50u        // where a pixel starts in the spectrum
#define STREAM_GEM 52u                   // gems/gem.cl: index is the pixel
#define STREAM_FACETS 64u                // inverse/search.h: iteration is the sweep, index the facet
#define STREAM_JUDGE 65u                 // inverse/judge.cl: iteration is the ray of a facet, index the facet

static inline uint4 philox4x32(uint4 counter, uint2 key) {
  ROLLED // otherwise compilers make all keys once, and keep them along the path
  for (int round = 0; round < 10; ++round) {
    const ulong a = (ulong)counter.x * 0xD2511F53u;
    const ulong b = (ulong)counter.z * 0xCD9E8D57u;
    counter = (uint4)((uint)(b >> 32) ^ counter.y ^ key.x, (uint)b, (uint)(a >> 32) ^ counter.w ^ key.y, (uint)a);
    key += (uint2)(0x9E3779B9u, 0xBB67AE85u);
  }
  return counter;
}

// Four uniforms in [0, 1): dimensions 4 block .. 4 block + 3 of item `index` in `iteration` of `stream`.
static inline float4 random4(uint2 seed, uint iteration, uint index, uint block, uint stream) {
  const uint4 bits = philox4x32((uint4)(index, iteration, block, stream), seed);
  return convert_float4(bits >> 8) * 0x1p-24f;
}

// Chooses by u in [0, 1) the first of several things with cdf > u. cdf: [count], the last 1 (app/tracing/scales.h).
static inline int choose(__global const float* cdf, int count, float u) {
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high) >> 1;
    if (cdf[middle] > u)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// The chance of all before the chosen one. Its own is cdf[chosen] less that.
static inline float chance_before(__global const float* cdf, int chosen) { return chosen > 0 ? cdf[chosen - 1] : 0.0f; }

// The place in its bin of a number that has drawn the bin. It is the middle of the number's 2^-24.
static inline float place_in_bin(__global const float* cdf, int bin, float number) {
  const float before = chance_before(cdf, bin);
  return (number + 0x1p-25f - before) / (cdf[bin] - before);
}
