// SPDX-License-Identifier: Apache-2.0
// Refraction at a facet, from inside the object to what is around it: app/inverse/bending.h in single precision.
#ifndef NEPHROID_BENDING_H
#define NEPHROID_BENDING_H

#include "kernels/scatter/fresnel.h"

// The part of the largest slope that is used: inverse::usable_part.
#define USABLE_PART 0.95f

static inline float3 direction_of(float2 slope) { return (float3)(slope, -1.0f) * rsqrt(1.0f + dot(slope, slope)); }
static inline float3 light_inside(float2 sines, float n) {
  return (float3)(sines, -copysign(sqrt(n * n - dot(sines, sines)), n));
}
static inline float2 slope_inside(float2 sines, float n) {
  return sines * copysign(rsqrt(n * n - dot(sines, sines)), n);
}

static inline float2 facet_gradient(float2 slope, float n, float2 sines) {
  const float3 along = light_inside(sines, n) - direction_of(slope);
  return -along.xy / along.z;
}

// The unit normal, out of the object; its length is 0 where no facet gives light this slope.
static inline float3 facet_normal(float2 slope, float n, float2 sines) {
  const float3 in = light_inside(sines, n), out = direction_of(slope);
  const float3 normal = n < 1.0f ? out - in : in - out;
  const float square = dot(normal, normal);
  const bool turns = square > 0.0f && n * dot(normal, in) > 0.0f && dot(normal, out) > 0.0f;
  return turns ? normal * rsqrt(square) : (float3)(0.0f);
}

// 1 minus Fresnel's reflectance; 1 for a mirror.
static inline float transmitted(float2 slope, float n, float2 sines) {
  if (n < 0.0f) return 1.0f;
  const float3 normal = facet_normal(slope, n, sines);
  const float cos_i = fmin(1.0f, dot(normal, light_inside(sines, n)) / n);
  if (!(cos_i > 0.0f)) return 0.0f;
  const float cos_t = refracted_cosine(cos_i, n);
  return cos_t < 0.0f ? 0.0f : 1.0f - fresnel_reflectance(cos_i, cos_t, n, 1.0f);
}

static inline bool is_reachable(float2 slope, float n, float2 sines, float steepest) {
  if (n > 0.0f) { // a mirror's steepness is its only limit
    const float n2 = n > 1.0f ? n * n : 1.0f / (n * n), most2 = USABLE_PART * USABLE_PART * (n2 - 1.0f);
#if NEPHROID_INCOMING
    const float cosine = dot(light_inside(sines, n), direction_of(slope)) / n;
    if (cosine <= 0.0f || cosine * cosine * (1.0f + most2) < 1.0f) return false;
#else
    if (dot(slope, slope) > most2) return false;
#endif
  }
  if (steepest == INFINITY) return true;
  const float2 g = facet_gradient(slope, n, sines);
  return dot(g, g) <= steepest * steepest;
}

// The change of the slope with the sines, along x and along y, and with the index: inverse::slope_change.
typedef struct {
  float2 by_sine_x, by_sine_y, by_index;
} SlopeChange;

static inline float2 change_of_slope(float3 dk, float dn, float2 slope, float n, float3 k, float3 out, float3 normal) {
  const float dk_n = dot(dk, normal), dc = (dot(k, normal) * dk_n - n * dn) / dot(out, normal);
  const float3 change = dk - (dk_n - dc) * normal;
  return -(change.xy + slope * change.z) / out.z;
}

static inline SlopeChange slope_change(float2 slope, float n, float2 sines) {
  const float3 k = light_inside(sines, n), out = direction_of(slope), normal = facet_normal(slope, n, sines);
  SlopeChange change = {(float2)(1.0f, 0.0f), (float2)(0.0f, 1.0f), (float2)(0.0f)};
  if (dot(normal, normal) == 0.0f) return change;
  change.by_sine_x = change_of_slope((float3)(1.0f, 0.0f, -sines.x / k.z), 0.0f, slope, n, k, out, normal);
  change.by_sine_y = change_of_slope((float3)(0.0f, 1.0f, -sines.y / k.z), 0.0f, slope, n, k, out, normal);
  change.by_index = change_of_slope((float3)(0.0f, 0.0f, n / k.z), 1.0f, slope, n, k, out, normal);
  return change;
}

#endif
