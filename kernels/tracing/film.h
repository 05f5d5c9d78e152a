// SPDX-License-Identifier: Apache-2.0
// The film: 64-bit fixed point, so that a sum has the same bits in any order and on every device.
// A film has one image or, for an estimate of its error, two independent halves: [half][pixel][3]. A meter's has
// eight replicates in their place.
#ifndef NEPHROID_FILM_HALVES
#define NEPHROID_FILM_HALVES 2
#endif

// Even and odd samples have random numbers of their own, also in a film of one image: a picture's bits are the same.
#define SAMPLE_SEQUENCES (NEPHROID_FILM_HALVES > 2 ? NEPHROID_FILM_HALVES : 2)

// One contribution may be at most 2^42 quanta: 2^20 of the largest still fit below 2^63.
#define FILM_LIMIT 0x1p42f

// The limit of a sample's contribution: `limit` for a pixel's first `enough` samples, then FILM_LIMIT too.
static inline float limit_of_sample(uint number, uint enough, float limit) {
  return number < enough ? limit : fmin(limit, FILM_LIMIT);
}

#ifdef NEPHROID_INT64_ATOMICS
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
static inline void add_exactly(volatile __global long* sum, long value) { atom_add(sum, value); }
#else
// Adds two 32-bit halves with carry: adding modulo 2^64 is associative, so in the end the bits are the sum's.
static inline void add_exactly(volatile __global long* sum, long value) {
  volatile __global uint* half_sum = (volatile __global uint*)sum;
  const uint low = (uint)value, before = atomic_add(half_sum, low);
  const uint carry = before + low < before ? 1u : 0u;
  const uint high = (uint)(value >> 32) + carry;
  if (high != 0u) atomic_add(half_sum + 1, high);
}
#endif

// The image that an iteration adds to.
static inline volatile __global long* film_of_iteration(volatile __global long* film, uint iteration, int pixels) {
  return film + 3 * (size_t)pixels * (iteration % NEPHROID_FILM_HALVES);
}

// The square of a contribution to the film in linear sRGB, in units of 2^12 of the film's quanta squared, at most 2^40.
// The sum over an emitter's photons decides its number of photons (app/photons/effort/emitters.h).
static inline long squared(float3 xyz, float scale) {
  const float3 q = xyz * (scale * 0x1p-6f);
  const float r = dot(q, (float3)(3.2406f, -1.5372f, -0.4986f)), g = dot(q, (float3)(-0.9689f, 1.8758f, 0.0415f)),
              b = dot(q, (float3)(0.0557f, -0.2040f, 1.0570f));
  const float sum = r * r + g * g + b * b;
  return convert_long_rte(sum < 0x1p40f ? sum : 0x1p40f);
}

// Adds xyz * scale to a pixel. dither: uniform in [0, 1). With it a contribution of q quanta, however small, adds q in
// the mean, where rounding to the nearest would lose small ones. False: not finite, or above `limit`.
static inline bool film_add_dithered(volatile __global long* film, int pixel, float3 xyz, float scale, float limit,
                                     float dither) {
  const float3 quanta = xyz * scale;
  if (!(fabs(quanta.x) <= limit && fabs(quanta.y) <= limit && fabs(quanta.z) <= limit)) return false;
  volatile __global long* sum = film + 3 * (size_t)pixel;
  const float shift = dither - 0.5f;
  add_exactly(sum, convert_long_rte(quanta.x + shift));
  add_exactly(sum + 1, convert_long_rte(quanta.y + shift));
  add_exactly(sum + 2, convert_long_rte(quanta.z + shift));
  return true;
}
