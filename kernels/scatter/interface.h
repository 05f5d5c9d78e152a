// SPDX-License-Identifier: Apache-2.0
// What a polished surface, or one microfacet of a rough one, does to a ray: a direction, by Snell's law, and the part
// of the light that is reflected, by Fresnel's equations or those of a thin film.
#include "kernels/scatter/thin_film.h"
#include "kernels/tracing/surface.h"

// A direction in which a surface sends a path on.
typedef struct {
  float3 direction;  // unit
  float3 normal;     // of what scattered the path: unit, on the side that it came from
  int near_material; // before and beyond an interface; -1: air
  int far_material;
  float reflectance; // the part that is reflected: 1 at a mirror and where all is
  float n_ratio;     // index of refraction before over that beyond; 1 where the path is reflected
  bool transmitted;
  bool straight; // nothing scattered it; the normal is set at a pane only
} ScatterSample;

// normal: unit, on the ray's side. u: uniform in [0, 1); the ray is reflected where it is below the reflectance.
static inline ScatterSample scatter_about(float3 direction, float3 normal, float n_i, float n_t, ThinFilm film,
                                          float u) {
  ScatterSample sample;
  sample.normal = normal;
  sample.near_material = sample.far_material = -1;
  sample.n_ratio = 1.0f;
  sample.straight = false;
  const float cos_i = clamp(-dot(direction, normal), 0.0f, 1.0f);
  const float eta = n_i / n_t;
  const float cos_t = refracted_cosine(cos_i, eta);
  sample.reflectance = cos_t >= 0.0f ? film_reflectance(cos_i, cos_t, n_i, n_t, film) : 1.0f;
  sample.transmitted = cos_t >= 0.0f && !(u < sample.reflectance);
  sample.direction = sample.transmitted ? refract_through(direction, normal, cos_i, cos_t, eta)
                                        : reflect_about(direction, normal, cos_i);
  return sample;
}

// Scatters about the shading normal, or where that sends the ray to the wrong side, about the triangle's own.
static inline ScatterSample scatter_at(float3 direction, const Surface* surface, float n_i, float n_t, ThinFilm film,
                                       float u) {
  const float side = dot(direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 geometric = side * surface->geometric;
  ScatterSample sample = scatter_about(direction, normal_before(direction, surface), n_i, n_t, film, u);
  const float leaves = dot(sample.direction, geometric);
  if (sample.transmitted ? leaves >= 0.0f : leaves <= 0.0f)
    sample = scatter_about(direction, geometric, n_i, n_t, film, u);
  return sample;
}

// The same at a surface that nothing passes.
#define REFLECTS_ALWAYS -1.0f
static inline ScatterSample reflect_at(float3 direction, const Surface* surface, float n_i, float n_t) {
  return scatter_at(direction, surface, n_i, n_t, no_film(), REFLECTS_ALWAYS);
}
