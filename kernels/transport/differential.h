// SPDX-License-Identifier: Apache-2.0
// How a path moves as glass bends it a little more: derivatives of its place and direction, carried from surface to
// surface as ray differentials are (Igehy 1999, "Tracing ray differentials"), with the wavelength in the place of the
// pixel (Elek et al. 2014, "Spectral ray differentials").
//
// They are taken with respect to one parameter s of the wavelength (app/tracing/wavelength_tables.h). A prime is d/ds,
// and n' = dn/ds of every material is given. Where s is the wavelength in nm, a path moves by P' a nanometre; where s
// is the index n itself, by P' a unit of n. Emission does not depend on the wavelength, so every path starts with P' =
// 0 and D' = 0. The surfaces that a path meets, and whether they reflect it, are held fixed.
#include "kernels/scatter/interaction.h"

// A ray P + t D meets the plane of unit normal G through its hit at P + t D, and so do its neighbours:
//   (P + t D)' = P' + t D' + t' D, and this is perpendicular to G, so t' = -(P' + t D').G / (D.G).
// direction: unit; distance: t.
static inline float3 transferred(const Differential* d, float3 direction, float distance, float3 geometric) {
  const float3 moved = d->position + distance * d->direction;
  return moved - dot(moved, geometric) / dot(direction, geometric) * direction;
}

// R = D + 2 c N, c = -D.N, so R' = D' + 2 (c' N + c N') with c' = -(D'.N + D.N').
static inline float3 reflected_differential(float3 direction, float3 d_direction, float3 normal, float3 d_normal) {
  const float cos_i = -dot(direction, normal);
  const float d_cos_i = -(dot(d_direction, normal) + dot(direction, d_normal));
  return d_direction + 2.0f * (d_cos_i * normal + cos_i * d_normal);
}

// T = e D + m N, m = e c - q, with e = n_i / n_t, c = -D.N, and q = cos of the angle of refraction, q^2 = 1 - e^2 (1 -
// c^2). So
//   T' = e' D + e D' + m' N + m N',  m' = e' c + e c' - q',  q' = (e^2 c c' - e e' (1 - c^2)) / q.
// Not finite at the critical angle, where q = 0.
static inline float3 refracted_differential(float3 direction, float3 d_direction, float3 normal, float3 d_normal,
                                            float eta, float d_eta) {
  const float cos_i = -dot(direction, normal);
  const float d_cos_i = -(dot(d_direction, normal) + dot(direction, d_normal));
  const float cos_t = refracted_cosine(cos_i, eta);
  const float d_cos_t = eta * (eta * cos_i * d_cos_i - d_eta * (1.0f - cos_i) * (1.0f + cos_i)) / cos_t;
  const float along = eta * cos_i - cos_t, d_along = d_eta * cos_i + eta * d_cos_i - d_cos_t;
  return d_eta * direction + eta * d_direction + d_along * normal + along * d_normal;
}

// N' of the interpolated normal N = m / |m|, m = n_0 + u (n_1 - n_0) + v (n_2 - n_0), as its place moves by P' in the
// triangle:
//   P' = u' e_1 + v' e_2 gives u' and v', m' = u' (n_1 - n_0) + v' (n_2 - n_0), and N' = (m' - (m'.N) N) / |m|.
// An ellipsoid has N = g / |g| with g = M^T M (P - centre), so g' = M^T M P' and N' = (g' - (g'.N) N) / |g|, which is
// P' / R for a sphere. position: on the primitive. The normal points outwards.
static inline float3 normal_differential(const DevicePrimitive* primitive, float3 position, float3 d_position) {
#if NEPHROID_ELLIPSOIDS
  if (is_ellipsoid(primitive)) {
    const float3 g = ellipsoid_gradient(primitive, to_unit_sphere(primitive, position - primitive->corner.xyz));
    const float3 d_g = ellipsoid_gradient(primitive, to_unit_sphere(primitive, d_position));
    const float gradient = length(g);
    const float3 along = g / gradient;
    return ellipsoid_side(primitive) * (d_g - dot(d_g, along) * along) / gradient;
  }
#endif
  const float3 a = primitive->corner.xyz, e1 = primitive->edge_u.xyz, e2 = primitive->edge_v.xyz;
  const VertexNormals n = vertex_normals(primitive);
  const float3 n0 = n.first, m1 = n.second - n0, m2 = n.third - n0;
  const float3 across = cross(e1, e2);
  const float3 to_u = cross(e2, across) / dot(across, across), to_v = cross(across, e1) / dot(across, across);
  const float3 mixed = n0 + dot(position - a, to_u) * m1 + dot(position - a, to_v) * m2;
  const float size = length(mixed);
  const float3 normal = mixed / size;
  const float3 d_mixed = dot(d_position, to_u) * m1 + dot(d_position, to_v) * m2;
  return (d_mixed - dot(d_mixed, normal) * normal) / size;
}

// Carries the derivatives to a surface that the path meets at `distance`.
static inline void differential_to_surface(Differential* d, float3 direction, float distance, const Surface* surface) {
  d->position = transferred(d, direction, distance, surface->geometric);
}

// Carries them across what scatters the path there. direction: before it. n_i, n_t and their n': equal at a mirror.
static inline void differential_through_surface(Differential* d, const Geometry* geometry, uint primitive,
                                                const Surface* surface, float3 direction, const ScatterSample* sample,
                                                float n_i, float n_t, float d_n_i, float d_n_t) {
  const float side = dot(direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  float3 d_normal = (float3)(0.0f);
  const DevicePrimitive met = geometry->primitives[primitive];
  const bool interpolated =
      NEPHROID_SMOOTH && kind_of(&met) == PRIMITIVE_SMOOTH && any(sample->normal != side * surface->geometric);
  if (interpolated || is_ellipsoid(&met)) d_normal = side * normal_differential(&met, surface->position, d->position);
  const float eta = n_i / n_t;
  d->direction = sample->transmitted ? refracted_differential(direction, d->direction, sample->normal, d_normal, eta,
                                                            (d_n_i - eta * d_n_t) / n_t)
                                   : reflected_differential(direction, d->direction, sample->normal, d_normal);
}

// Carries the path's derivatives to a surface and across what scatters it there, before `path` itself goes on.
static inline void scatter_differentials(const World* world, Path* path, const Interaction* at, const Band* band,
                                         const ScatterSample* sample) {
  const Surface* surface = &at->surface;
  const float distance = dot(surface->position - path->origin, path->direction);
#if NEPHROID_PLACE_DIFFERENTIALS
  for (int i = 0; i < 2; ++i) {
    differential_to_surface(&path->by_place[i], path->direction, distance, surface);
    if (sample->straight) continue;
    __global const float* n_of = index_of_band(world, band);
    const int near = sample->near_material, far = sample->far_material;
    differential_through_surface(&path->by_place[i], &world->geometry, at->triangle, surface, path->direction, sample,
                                 near < 0 ? 1.0f : n_of[near], far < 0 ? 1.0f : n_of[far], 0.0f, 0.0f);
  }
#endif
#if NEPHROID_DIFFERENTIALS
  differential_to_surface(&path->differential, path->direction, distance, surface);
  if (sample->straight) return;
  __global const float* n_of = index_of_band(world, band);
  __global const float* slope_of = world->index_slope + band->cluster * world->scene.material_count;
  const int near = sample->near_material, far = sample->far_material;
  differential_through_surface(&path->differential, &world->geometry, at->triangle, surface, path->direction, sample,
                               near < 0 ? 1.0f : n_of[near], far < 0 ? 1.0f : n_of[far],
                               near < 0 ? 0.0f : slope_of[near], far < 0 ? 0.0f : slope_of[far]);
#endif
}
