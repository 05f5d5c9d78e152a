// SPDX-License-Identifier: Apache-2.0
// Rough glass and rough mirrors: microfacets with the distribution GGX (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces") and Smith's masking, which is correlated with height where light comes in and
// leaves (Heitz 2014; through the surface by the same formula, as pbrt-v4 has it). A path meets one of the facets that
// it can see, drawn as Dupuy and Benyoub 2023 do, and is bent there as at a smooth surface. What is left of it is the
// masking of both its ways over that of the first. Light that would meet several facets is lost.
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

// D(h) over 1 + Lambda of both ways. facet: h, unit, on the side of n. Its 1 + (alpha^2 - 1) cos^2 is written as sin^2
// + alpha^2 cos^2, which stays exact for small alpha.
static inline float facets_between(float3 facet, float3 n, float cos_view, float cos_light, float alpha) {
  const float cosine = dot(facet, n);
  const float3 aside = facet - cosine * n;
  const float denominator = dot(aside, aside) + alpha * alpha * cosine * cosine;
  const float density = alpha * alpha / (PI_F * denominator * denominator);
  return density / (1.0f + smith_lambda(cos_view, alpha) + smith_lambda(cos_light, alpha));
}

// The radiance that facets reflect to `view` over the irradiance on the surface from the direction `light`, but for
// Fresnel's factor (Walter et al., equation 20). All unit and on the side of n.
static inline float reflected_by_facets(float3 view, float3 light, float3 n, float3 facet, float alpha) {
  const float cos_view = dot(view, n), cos_light = dot(light, n);
  return facets_between(facet, n, cos_view, cos_light, alpha) / (4.0f * cos_view * cos_light);
}

// The same of what goes through, from a light beyond (equation 21). facet: that of facet_between.
static inline float transmitted_by_facets(float3 view, float3 light, float3 n, float3 facet, float n_view,
                                          float n_light, float alpha) {
  const float cos_view = dot(view, n), cos_light = -dot(light, n);
  const float view_facet = dot(view, facet), light_facet = dot(light, facet);
  const float along = n_light * light_facet + n_view * view_facet;
  return facets_between(facet, n, cos_view, cos_light, alpha) * view_facet * fabs(light_facet) * n_view * n_view /
         (cos_view * cos_light * along * along);
}

// The normal, on the side of n, of the facet that refracts light to the view. There is none where both lie on one side
// of what this gives.
static inline float3 facet_between(float3 view, float3 light, float3 n, float n_view, float n_light) {
  const float3 facet = normalize(n_light * light + n_view * view);
  return dot(facet, n) > 0.0f ? facet : -facet;
}

// What is left of light that came along `arriving` and was bent at a facet. n: unit, on the side that it came from.
static inline float unmasked(float3 arriving, const Bend* bend, float3 n, float alpha) {
  const float out = bend->transmitted ? -dot(bend->direction, n) : dot(bend->direction, n);
  if (!(out > 0.0f)) return 0.0f;
  const float seen = 1.0f + smith_lambda(-dot(arriving, n), alpha);
  return seen / (seen + smith_lambda(out, alpha));
}
