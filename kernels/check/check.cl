// SPDX-License-Identifier: Apache-2.0
// Runs the functions of kernels/*.h over arrays, one item each, so that `nephroid check` (app/check) and tests hold
// them against the host. Only built_ins computes something else: it runs the device's own functions.
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/tracing/random.h"
#include "kernels/scatter/scatter.h"
#include "kernels/lights/lights.h"
#include "kernels/tracing/work_item.h"

// The order of app/check/arithmetic.cpp.
enum {
  FUNCTION_EXP, FUNCTION_LOG, FUNCTION_SQRT, FUNCTION_RSQRT, FUNCTION_SIN, FUNCTION_COS, FUNCTION_DIVIDE, FUNCTION_FMA,
  FUNCTION_DIFFERENCE
};

// x y - z w with each operation rounded, on which the signs of bvh.h's edge functions rest.
static inline float difference_of_products(float4 a) {
#pragma OPENCL FP_CONTRACT OFF
  const float first = a.x * a.y, second = a.z * a.w;
  return first - second;
}

static inline float built_in(int function, float4 a) {
  float cosine;
  switch (function) {
  case FUNCTION_EXP: return exp(a.x);
  case FUNCTION_LOG: return log(a.x);
  case FUNCTION_SQRT: return sqrt(a.x);
  case FUNCTION_RSQRT: return rsqrt(a.x);
  case FUNCTION_SIN: return sincos(a.x, &cosine);
  case FUNCTION_COS: sincos(a.x, &cosine); return cosine;
  case FUNCTION_DIVIDE: return a.x / a.y;
  case FUNCTION_FMA: return fma(a.x, a.y, a.z);
  }
  return difference_of_products(a);
}

kernel void built_ins(int function, global const float4* in, global float* out, uint count) {
  const uint i = work_item();
  if (i < count) out[i] = built_in(function, in[i]);
}

kernel void to_quanta(global const float* in, global long* out, uint count) {
  const uint i = work_item();
  if (i < count) out[i] = convert_long_rte(in[i]);
}

kernel void philox(global const uint4* counters, global const uint2* keys, global uint4* results, uint count) {
  const uint i = work_item();
  if (i < count) results[i] = philox4x32(counters[i], keys[i]);
}

kernel void sobol_points(uint2 seed, global float4* results, uint count) {
  const uint i = work_item();
  if (i < count) results[i] = sobol4(seed, (uint3)(3u, 1u, 0u), 0u, i);
}

kernel void uniforms(uint2 seed, uint pass, uint block, uint stream, global float4* results, uint count) {
  const uint i = work_item();
  if (i < count) results[i] = random4(seed, pass, i, block, stream);
}

// in: cos_i, n_i, n_t. out: cos_t, negative for total reflection; reflectance.
kernel void interfaces(global const float4* in, global float4* out, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const float cos_t = refracted_cosine(in[i].x, in[i].y / in[i].z);
  const float r = cos_t < 0.0f ? 1.0f : fresnel_reflectance(in[i].x, cos_t, in[i].y, in[i].z);
  out[i] = (float4)(cos_t, r, 0.0f, 0.0f);
}

// in: cos_i, then n and k of a metal, over the index before it. out: x: its reflectance.
kernel void conductors(global const float4* in, global float4* out, uint count) {
  const uint i = work_item();
  if (i < count) out[i] = (float4)(conductor_reflectance(in[i].x, in[i].y, in[i].z), 0.0f, 0.0f, 0.0f);
}

// in: cos_i, n before and beyond, then n of a thin film; its thickness in wavelengths. out: x: the interface's
// reflectance.
kernel void coatings(global const float4* in, global float4* out, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const float4 at = in[2 * i];
  const ThinFilm film = {at.w, in[2 * i + 1].x};
  const float cos_t = refracted_cosine(at.x, at.y / at.z);
  const float r = cos_t < 0.0f ? 1.0f : coated_reflectance(at.x, cos_t, at.y, at.z, film);
  out[i] = (float4)(r, cos_t, 0.0f, 0.0f);
}

// view: the direction that the microfacets about z are seen from; w: alpha.
kernel void visible_microfacets(global const float4* view, uint2 seed, global float4* out, uint count) {
  const uint i = work_item();
  const float3 up = (float3)(0.0f, 0.0f, 1.0f);
  if (i >= count) return;
  const float2 u = microfacet_numbers(seed, 0u, i, 0u, STREAM_PHOTONS);
  out[i] = (float4)(visible_microfacet(view->xyz, up, view->w, u), 0.0f);
}

// in: a direction that meets the plane z = 0, and n_i / n_t. out: the reflected one; the refracted one, its cosine.
kernel void directions(global const float4* in, global float4* out, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const float3 d = in[i].xyz, n = (float3)(0.0f, 0.0f, 1.0f);
  const float cos_i = -d.z, cos_t = refracted_cosine(cos_i, in[i].w);
  out[2 * i] = (float4)(reflect_about(d, n, cos_i), 0.0f);
  out[2 * i + 1] = (float4)(cos_t < 0.0f ? (float3)(0.0f) : refract_through(d, n, cos_i, cos_t, in[i].w), cos_t);
}

// Each item walks through nested objects. A step k >= 0 enters object k, ~k leaves it. mediums: after each step the
// medium, -1 for air, or -2 where the list of media is full.
kernel void media_walks(global const DeviceObject* objects, global const int* steps, global int* mediums,
                        int steps_each, uint count) {
  const uint walk = work_item();
  if (walk >= count) return;
  Media media = {0ul, 0ul};
  for (int s = 0; s < steps_each; ++s) {
    const int step = steps[walk * (uint)steps_each + (uint)s];
    bool fits = true;
    if (step >= 0)
      fits = enter_medium(&media, step);
    else
      leave_medium(&media, ~step);
    mediums[walk * (uint)steps_each + (uint)s] = fits ? medium_object(&media, objects) : -2;
  }
}

// in: light, cluster, reflector, row of attenuation; and the length crossed there. out: what is left of the cluster's
// light. It is summed four wavelengths at a time.
kernel void attenuated(global const int* first, global const int* wavelengths, global const float* coefficient,
                       global const float4* light_xyz, global const float* reflectance, global const int4* in,
                       global const float* lengths, global float4* out, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const SpectralTables tables = {.cluster_first = first,
                                 .cluster_wavelengths = wavelengths,
                                 .coefficient = coefficient,
                                 .light_xyz = light_xyz,
                                 .reflectance = reflectance};
  const Reflector reflector = reflector_of_row(in[i].z);
  float4 sum = (float4)(0.0f);
  const int end = first[in[i].y + 1];
  for (int w = first[in[i].y]; w < end; w += 4) {
    Band band = whole_cluster(in[i].y);
    band.own.wavelengths = (int4)(wavelengths[w], wavelengths[min(w + 1, end - 1)], wavelengths[min(w + 2, end - 1)],
                                  wavelengths[min(w + 3, end - 1)]);
    band.own.weights = (float4)(1.0f, w + 1 < end, w + 2 < end, w + 3 < end);
    band.own.middle = wavelengths[w];
    Throughput throughput = full_throughput();
    attenuate(&tables, &throughput, &band, in[i].w, lengths[i]);
    const float4 all = members_light(&tables, in[i].x, w, min(w + 4, end), reflector);
    sum += coloured_light(&tables, &throughput.own, all, in[i].x, &band.own, reflector);
  }
  out[i] = sum;
}

// out: for photon i of a light origin and watts, then direction.
kernel void emissions(global const DeviceLight* lights, int light, global const DeviceTarget* targets,
                      DeviceScene scene, uint2 seed, global float4* out, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const World world = {.lights = lights, .targets = targets, .scene = scene};
  const Emission e = emit(&world, light, random4(seed, 0u, i, 0u, STREAM_PHOTONS),
                          random4(seed, 0u, i, 1u, STREAM_PHOTONS).xy);
  out[2 * i] = (float4)(e.origin, e.watts);
  out[2 * i + 1] = (float4)(e.direction, 0.0f);
}
