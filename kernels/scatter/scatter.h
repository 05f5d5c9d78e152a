// SPDX-License-Identifier: Apache-2.0
// What a surface can do to light, whatever its material: a file each does it. As pbrt-v4's BxDF has it:
//
//   lobes_of(material)        the ways in which it sends light on
//   choose_lobes(...)         to all sides, or by the other lobes
//   sample_scatter(...)       a direction of those, with what the light loses there
//   evaluate_scatter(...)     the part of a rough surface's light that goes from one direction to another
//   albedo_at, part_to_base   its diffuse lobe: albedo / pi times both parts
//
// A photon carries power, a path from the eye radiance, which a surface multiplies by ScatterSample::n_ratio squared
// (Nicodemus 1963, "Radiance"): that is up to who follows the path.
#include "kernels/scatter/conductor.h"
#include "kernels/scatter/dielectric.h"
#include "kernels/scatter/diffuse.h"
#include "kernels/scatter/glazing.h"
#include "kernels/scatter/microfacet.h"
#include "kernels/scatter/mirror.h"
#include "kernels/scatter/plastic.h"
#include "kernels/scatter/texture.h"
#include "kernels/scatter/varnished_metal.h"

// What a path meets at a hit.
static inline Interaction interaction_at(const World* world, Hit hit) {
  Interaction at;
  at.surface = surface_of(world, hit);
  at.triangle = hit.primitive;
  at.material = material_at(world, &at.surface, hit.primitive);
  return at;
}

static inline float coat_reflectance(const World* world, const DeviceMaterial* material, float cos_i) {
#define CASE_OF_MATERIAL(word, NAME, lobes) \
  if (is_material(material, MATERIAL_##NAME)) return word##_coat_reflectance(world, material, cos_i);
  MATERIALS(CASE_OF_MATERIAL)
#undef CASE_OF_MATERIAL
  return 0.0f;
}

// The part of light that reaches the base of a matt surface along the unit vector `way`, or comes from it: 1 where
// there is no coat.
static inline float part_to_base(const World* world, const Surface* surface, float3 way) {
  const DeviceMaterial material = material_of(world, surface->object);
  const float cosine = fabs(dot(way, surface->shading));
#define CASE_OF_MATERIAL(word, NAME, lobes) \
  if (is_material(&material, MATERIAL_##NAME)) return word##_part_to_base(world, &material, cosine);
  MATERIALS(CASE_OF_MATERIAL)
#undef CASE_OF_MATERIAL
  return 0.0f;
}

// The part of light from all sides that passes the coat of a matt surface.
static inline float mean_part_to_base(const World* world, const DeviceMaterial* material) {
  return has_coat(material) ? world->tables.surface_data[material->surface_first + COAT_MEAN] : 1.0f;
}

// A direction of the lobes but the diffuse one, about the shading normal, as if polished.
static inline bool scatter_polished(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                    ScatterSample* sample) {
#define CASE_OF_MATERIAL(word, NAME, lobes) \
  if (is_material(&at->material, MATERIAL_##NAME)) return word##_scatter(world, path, at, band, u, sample);
  MATERIALS(CASE_OF_MATERIAL)
#undef CASE_OF_MATERIAL
  return false;
}

static inline bool is_rough(const DeviceMaterial* material) { return NEPHROID_ROUGH && material->alpha > 0.0f; }

// The two numbers in [0, 1) that choose a microfacet at surface `surface_number` of path `index`.
static inline float2 microfacet_numbers(uint2 seed, uint iteration, uint index, uint surface_number, uint stream) {
  return NEPHROID_ROUGH ? random4(seed, iteration, index, 0x40000000u | surface_number, stream).xy : (float2)(0.0f);
}

// LOBE_DIFFUSE, or the others: by the part that a coat reflects. u: uniform in [0, 1). u_microfacet:
// microfacet_numbers.
static inline uint choose_lobes(const World* world, float3 arriving, const Interaction* at, float u,
                                float2 u_microfacet) {
  const uint lobes = lobes_of(&at->material);
  if (!has_coat(&at->material)) return lobes;
  float3 normal = normal_before(arriving, &at->surface);
  if (is_rough(&at->material)) normal = visible_microfacet(-arriving, normal, at->material.alpha, u_microfacet);
  const float cos_i = clamp(-dot(arriving, normal), 0.0f, 1.0f);
  return u < coat_reflectance(world, &at->material, cos_i) ? lobes & ~LOBE_DIFFUSE : LOBE_DIFFUSE;
}

// Scatters a path by the lobes that are wanted, all but the diffuse one. It takes from the path what the surface does,
// and changes its media; not yet its direction. Where one of reflection and transmission is wanted, the path takes it
// where it is there, else the other one, and sample->reflectance says what each has; where both are, u chooses. u,
// u_microfacet: as in choose_lobes. False: the path is lost, in more than MEDIA_DEPTH media.
static inline bool sample_scatter(const World* world, Path* path, const Interaction* at, const Band* band, uint lobes,
                                  float u, float2 u_microfacet, ScatterSample* sample) {
  if ((lobes & LOBE_TRANSMISSION) == 0u)
    u = 0.0f;
  else if ((lobes & LOBE_REFLECTION) == 0u)
    u = 1.0f;
  if (!is_rough(&at->material)) return scatter_polished(world, path, at, band, u, sample);
  const float side = dot(path->direction, at->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 n = normal_before(path->direction, &at->surface);
  const float3 m = visible_microfacet(-path->direction, n, at->material.alpha, u_microfacet);
  Interaction at_microfacet = *at;
  at_microfacet.surface.shading = side * m;
  if (!scatter_polished(world, path, &at_microfacet, band, u, sample)) return false;
  if (sample->straight) return true;
  // scatter_at takes the triangle's own normal where the microfacet sends the path to the wrong side.
  leave_part(&path->throughput,
             any(sample->normal != m) ? 0.0f : unmasked(path->direction, sample, n, at->material.alpha));
  return true;
}

// The part of the irradiance from the unit direction `way` that a rough surface sends back along the path, per
// steradian: reflected, or through it from beyond. It takes from `path` what the surface does. 0: none.
static inline float evaluate_scatter(const World* world, Path* path, const Interaction* at, const Band* band,
                                     float3 way, bool beyond) {
  const float side = dot(path->direction, at->surface.geometric) < 0.0f ? 1.0f : -1.0f, alpha = at->material.alpha;
  const float3 n = normal_before(path->direction, &at->surface), view = -path->direction;
  float3 m = normalize(view + way);
  float part;
  if (beyond) {
    Sides sides;
    if (!find_sides(&path->media, &at->surface, world->objects, index_of_band(world, band), path->direction, &sides))
      return 0.0f;
    m = refracting_microfacet(view, way, n, sides.n_near, sides.n_far);
    if (!(dot(view, m) > 0.0f) || !(dot(way, m) < 0.0f)) return 0.0f;
    part = transmitted_by_microfacets(view, way, n, m, sides.n_near, sides.n_far, alpha);
  } else
    part = reflected_by_microfacets(view, way, n, m, alpha);
  Interaction at_microfacet = *at;
  at_microfacet.surface.shading = side * m;
  ScatterSample sample;
  if (!scatter_polished(world, path, &at_microfacet, band, beyond ? 1.0f : 0.0f, &sample)) return 0.0f;
  if (sample.straight || sample.transmitted != beyond) return 0.0f;
  Parts reflected;
  if (!reflected_parts(world, at, path->direction, band, &sample, &reflected))
    return part * (beyond ? 1.0f - sample.reflectance : sample.reflectance);
  leave_parts(&path->throughput.own, beyond ? without_parts(reflected) : reflected);
  return part;
}

// Takes from a path that a coat has reflected what would have passed it.
static inline void lose_to_base(Path* path, const ScatterSample* sample) {
  leave_part(&path->throughput, sample->reflectance);
}
