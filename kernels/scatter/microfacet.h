// SPDX-License-Identifier: Apache-2.0
// Rough surfaces: microfacets with the distribution GGX (Walter et al. 2007, "Microfacet Models for Refraction through
// Rough Surfaces") and Smith's masking, which is correlated with height where light comes in and leaves (Heitz 2014;
// through the surface by the same formula, as pbrt-v4 has it). A path meets one of the microfacets that it can see,
// drawn as Dupuy and Benyoub 2023 do, and is scattered there as at a polished surface. What is left of it is the
// masking of both its ways over that of the first. Light that would meet several microfacets is lost.
#include "kernels/scatter/interface.h"
#include "kernels/tracing/frame.h"
#include "kernels/tracing/random.h"

// 0: every surface is polished.
#ifndef NEPHROID_ROUGH
#define NEPHROID_ROUGH 1
#endif

// Smith's Lambda of GGX; 1 / (1 + Lambda) of the microfacets that face a direction are not masked. cosine: of its angle
// to the normal, not 0.
static inline float smith_lambda(float cosine, float alpha) {
  const float tangent2 = (1.0f - cosine) * (1.0f + cosine) / (cosine * cosine);
  return 0.5f * (sqrt(1.0f + alpha * alpha * tangent2) - 1.0f);
}

// The normal of a microfacet, by the share that each has of what is seen from `view`: D(m) max(view . m, 0) / (view . n
// (1 + Lambda(view))). view: unit, on the side of n. alpha: the slopes' root mean square, but for a factor. u: uniform
// in [0, 1) x [0, 1).
static inline float3 visible_microfacet(float3 view, float3 n, float alpha, float2 u) {
  float3 x, y;
  make_frame(n, &x, &y);
  const float3 stretched = normalize((float3)(alpha * dot(view, x), alpha * dot(view, y), dot(view, n)));
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * u.x, &cosine_phi);
  const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
  const float radius = sqrt(clamp((1.0f - z) * (1.0f + z), 0.0f, 1.0f));
  const float3 half_way = stretched + (float3)(radius * cosine_phi, radius * sine_phi, z);
  return normalize(alpha * half_way.x * x + alpha * half_way.y * y + half_way.z * n);
}

// D(m) over 1 + Lambda of both ways. m: a microfacet's normal, unit, on the side of n. Its 1 + (alpha^2 - 1) cos^2 is
// written as sin^2 + alpha^2 cos^2, which stays exact for small alpha.
static inline float microfacets_between(float3 m, float3 n, float cos_view, float cos_light, float alpha) {
  const float cosine = dot(m, n);
  const float3 aside = m - cosine * n;
  const float denominator = dot(aside, aside) + alpha * alpha * cosine * cosine;
  const float density = alpha * alpha / (PI_F * denominator * denominator);
  return density / (1.0f + smith_lambda(cos_view, alpha) + smith_lambda(cos_light, alpha));
}

// The radiance that microfacets reflect to `view` over the irradiance on the surface from the direction `light`, but
// for Fresnel's factor (Walter et al., equation 20). All unit and on the side of n. m: half way between both.
static inline float reflected_by_microfacets(float3 view, float3 light, float3 n, float3 m, float alpha) {
  const float cos_view = dot(view, n), cos_light = dot(light, n);
  return microfacets_between(m, n, cos_view, cos_light, alpha) / (4.0f * cos_view * cos_light);
}

// The same of what goes through, from a light beyond (equation 21). m: that of refracting_microfacet.
static inline float transmitted_by_microfacets(float3 view, float3 light, float3 n, float3 m, float n_view,
                                               float n_light, float alpha) {
  const float cos_view = dot(view, n), cos_light = -dot(light, n);
  const float view_m = dot(view, m), light_m = dot(light, m);
  const float along = n_light * light_m + n_view * view_m;
  return microfacets_between(m, n, cos_view, cos_light, alpha) * view_m * fabs(light_m) * n_view * n_view /
         (cos_view * cos_light * along * along);
}

// The normal, on the side of n, of the microfacet that refracts light to the view. There is none where both lie on one
// side of what this gives.
static inline float3 refracting_microfacet(float3 view, float3 light, float3 n, float n_view, float n_light) {
  const float3 m = normalize(n_light * light + n_view * view);
  return dot(m, n) > 0.0f ? m : -m;
}

// What is left of light that came along `arriving` and was scattered at a microfacet. n: unit, on the side that it came
// from.
static inline float unmasked(float3 arriving, const ScatterSample* sample, float3 n, float alpha) {
  const float out = sample->transmitted ? -dot(sample->direction, n) : dot(sample->direction, n);
  if (!(out > 0.0f)) return 0.0f;
  const float seen = 1.0f + smith_lambda(-dot(arriving, n), alpha);
  return seen / (seen + smith_lambda(out, alpha));
}
