// SPDX-License-Identifier: Apache-2.0
// Rough glass and rough mirrors: microfacets with the distribution GGX (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces") and Smith's masking, which is correlated with height where light comes in and
// leaves (Heitz 2014). A path meets one of the facets that it can see, drawn as Dupuy and Benyoub 2023 do, and is bent
// there as at a smooth surface. What is left of it is the masking of both its ways over that of the first. Light that
// would meet several facets is lost.
#include "kernels/tracing/frame.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/surface.h"

// 0: every surface is polished.
#ifndef NEPHROID_ROUGH
#define NEPHROID_ROUGH 1
#endif

// The two numbers in [0, 1) that choose a facet at surface `surface_number` of path `index`; BEFORE_THE_PATH: at its
// first bend (first_bend of eye_path.h).
#define BEFORE_THE_PATH 0xffffu
static inline float2 facet_numbers(uint2 seed, uint iteration, uint index, uint surface_number, uint stream) {
#if NEPHROID_ROUGH
  return random4(seed, iteration, index, 0x40000000u | surface_number, stream).xy;
#else
  return (float2)(0.0f);
#endif
}

// Smith's Lambda of GGX; 1 / (1 + Lambda) of the facets that face a direction are not masked. cosine: of its angle to
// the normal, not 0.
static inline float smith_lambda(float cosine, float alpha) {
  const float tangent2 = (1.0f - cosine) * (1.0f + cosine) / (cosine * cosine);
  return 0.5f * (sqrt(1.0f + alpha * alpha * tangent2) - 1.0f);
}

// The normal of a facet, by the share that each has of what is seen from `view`: D(h) max(view . h, 0) / (view . n
// (1 + Lambda(view))). view: unit, on the side of n. alpha: the slopes' root mean square, but for a factor.
static inline float3 visible_facet(float3 view, float3 n, float alpha, float2 choice) {
  float3 x, y;
  make_frame(n, &x, &y);
  const float3 stretched = normalize((float3)(alpha * dot(view, x), alpha * dot(view, y), dot(view, n)));
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * choice.x, &cosine_phi);
  const float z = (1.0f - choice.y) * (1.0f + stretched.z) - stretched.z;
  const float radius = sqrt(clamp((1.0f - z) * (1.0f + z), 0.0f, 1.0f));
  const float3 half_way = stretched + (float3)(radius * cosine_phi, radius * sine_phi, z);
  return normalize(alpha * half_way.x * x + alpha * half_way.y * y + half_way.z * n);
}

// What is left of light that came along `arriving` and was bent at a facet. n: unit, on the side that it came from.
static inline float unmasked(float3 arriving, const Bend* bend, float3 n, float alpha) {
  const float out = bend->transmitted ? -dot(bend->direction, n) : dot(bend->direction, n);
  if (!(out > 0.0f)) return 0.0f;
  const float seen = 1.0f + smith_lambda(-dot(arriving, n), alpha);
  return seen / (seen + smith_lambda(out, alpha));
}
