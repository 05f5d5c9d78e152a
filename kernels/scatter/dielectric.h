// SPDX-License-Identifier: Apache-2.0
// Glass, water, diamond: which media meet at the surface, and whether a path is reflected or goes through. The surface
// may have a tint, and one thin film as its coating. A pane has no thickness: what goes through goes straight on, and
// all reflections between its two faces are summed, R + T R T + T R^3 T + ... = 2 R / (1 + R) with T = 1 - R. Light
// keeps its polarisation between them: the mean is taken of both sums.
#include "kernels/scatter/interaction.h"
#include "kernels/scatter/texture.h"

// 0: every dielectric has n = 1, so nothing is bent or reflected.
#ifndef NEPHROID_BENDING
#define NEPHROID_BENDING 1
#endif

// 0: no object is a pane.
#ifndef NEPHROID_PANES
#define NEPHROID_PANES 1
#endif

// 0: no surface of glass has a tint.
#ifndef NEPHROID_TINTS
#define NEPHROID_TINTS 1
#endif

// What meets at a surface. The objects whose media they are, -1: air; the indices of refraction there.
typedef struct {
  int near_object, far_object;
  float n_near, n_far;
  Media beyond;
} Sides;

static inline float index_of_object(int object, __global const DeviceObject* objects, __global const float* n_of) {
  return object < 0 ? 1.0f : n_of[objects[object].material];
}

static inline int material_number(const World* world, int object) {
  return object < 0 ? -1 : world->objects[object].material;
}

// media: those that enclose a path along `direction`. n_of: index of refraction by material, for the path's cluster.
// False: more than MEDIA_DEPTH media.
static inline bool find_sides(const Media* media, const Surface* surface, __global const DeviceObject* objects,
                              __global const float* n_of, float3 direction, Sides* sides) {
  sides->beyond = *media;
  sides->near_object = medium_object(media, objects);
  if (dot(direction, surface->geometric) < 0.0f) {
    if (!enter_medium(&sides->beyond, surface->object)) return false;
  } else if (is_inside(media, surface->object))
    leave_medium(&sides->beyond, surface->object);
  else
    sides->near_object = surface->object; // an open mesh: the path got in without meeting its surface
  sides->far_object = medium_object(&sides->beyond, objects);
  sides->n_near = index_of_object(sides->near_object, objects, n_of);
  sides->n_far = index_of_object(sides->far_object, objects, n_of);
  return true;
}

static inline ThinFilm coating_at(const World* world, const DeviceMaterial* material, int wavelength) {
  ThinFilm film = no_film();
#if NEPHROID_COATINGS
  if (material->surface_first >= 0) {
    film.n = world->tables.surface_data[material->surface_first + wavelength];
    film.thickness = world->tables.surface_data[material->surface_first + WAVELENGTH_COUNT + wavelength];
  }
#endif
  return film;
}

// The part that a coated surface reflects of a wavelength that meets it as the sample does.
static inline float coated_part(const World* world, const DeviceMaterial* material, const ScatterSample* sample,
                                float cos_i, int wavelength) {
  __global const float* n_of = index_of_wavelength(world, wavelength);
  const float n_near = sample->near_material < 0 ? 1.0f : n_of[sample->near_material],
              n_far = sample->far_material < 0 ? 1.0f : n_of[sample->far_material],
              cos_t = refracted_cosine(cos_i, n_near / n_far);
  return cos_t < 0.0f ? 1.0f
                      : film_reflectance(cos_i, cos_t, n_near, n_far, coating_at(world, material, wavelength));
}

// The parts that a surface reflects of all wavelengths of a path that arrives along a direction, as its leader is
// scattered. False: they are alike, and the sample tells; only a coating makes them differ.
static inline bool reflected_parts(const World* world, const Interaction* at, float3 arriving, const Band* band,
                                const ScatterSample* sample, Parts* parts) {
  if (NEPHROID_COATINGS == 0 || !is_material(&at->material, MATERIAL_DIELECTRIC) || at->material.surface_first < 0 ||
      sample->straight || sample->near_material == sample->far_material)
    return false;
  const float cos_i = clamp(-dot(arriving, sample->normal), 0.0f, 1.0f);
  const int4 w = band->own.wavelengths;
  parts->four = (float4)(coated_part(world, &at->material, sample, cos_i, w.x),
                         coated_part(world, &at->material, sample, cos_i, w.y),
                         coated_part(world, &at->material, sample, cos_i, w.z),
                         coated_part(world, &at->material, sample, cos_i, w.w));
  parts->middle = coated_part(world, &at->material, sample, cos_i, band->own.middle);
  return true;
}

// n: index of the medium around, n_pane: of the pane. u: as in scatter_about.
static inline ScatterSample scatter_at_pane(float3 direction, const Surface* surface, float n, float n_pane, float u) {
  ScatterSample sample = reflect_at(direction, surface, n, n_pane);
  if (sample.reflectance == 1.0f) return sample;
  const float cos_i = clamp(-dot(direction, sample.normal), 0.0f, 1.0f), cos_t = refracted_cosine(cos_i, n / n_pane);
  const float2 amplitudes = fresnel_amplitudes(cos_i, cos_t, n, n_pane), face = amplitudes * amplitudes,
               both = 2.0f * face / (1.0f + face);
  sample.reflectance = 0.5f * (both.x + both.y);
  if (!(u < sample.reflectance)) {
    sample.direction = direction;
    sample.transmitted = sample.straight = true;
  }
  return sample;
}

static inline Parts reflectance_parts(const SpectralTables* tables, Reflector reflector, const Carriers* carriers) {
  const int4 w = carriers->wavelengths;
  const Parts parts = {(float4)(reflectance_of(tables, reflector, w.x), reflectance_of(tables, reflector, w.y),
                                reflectance_of(tables, reflector, w.z), reflectance_of(tables, reflector, w.w)),
                       reflectance_of(tables, reflector, carriers->middle)};
  return parts;
}

// Leaves what a tint lets pass.
static inline void pass_tint(const World* world, Path* path, const Interaction* at, const Band* band) {
#if NEPHROID_TINTS
  attenuate(&world->tables, &path->throughput, band, at->material.tint, 1.0f);
#if NEPHROID_TINT_TEXTURES
  if (at->material.texture >= 0) {
    const Reflector tint = tint_at(world, at);
    LEAVE_BY_WAVELENGTH(&path->throughput, band, reflectance_parts(&world->tables, tint, carriers))
  }
#endif
#endif
}

// Says that a path has met a surface between these materials, which reflects or bends each wavelength otherwise.
static inline void split(const World* world, Path* path, int near_material, int far_material) {
  path->throughput.is_split = path->throughput.is_split ||
                              (near_material >= 0 && world->materials[near_material].splits_wavelengths) ||
                              (far_material >= 0 && world->materials[far_material].splits_wavelengths);
}

static inline bool dielectric_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                      ScatterSample* sample) {
  __global const float* n_of = index_of_band(world, band);
  const Surface* surface = &at->surface;
#if NEPHROID_PANES
  if (at->material.is_thin) {
    const int around = medium_object(&path->media, world->objects);
    *sample = scatter_at_pane(path->direction, surface, index_of_object(around, world->objects, n_of),
                              n_of[world->objects[surface->object].material], u);
    sample->near_material = sample->far_material = material_number(world, around);
    split(world, path, sample->near_material, material_number(world, surface->object));
    if (sample->transmitted) pass_tint(world, path, at, band);
    return true;
  }
#endif
  Sides sides;
  if (!find_sides(&path->media, surface, world->objects, n_of, path->direction, &sides)) return false;
  const ThinFilm coating = coating_at(world, &at->material, max(band->wavelength, 0)); // the plan gives every path one
  const bool coated = coating.thickness > 0.0f && sides.near_object != sides.far_object;
  if (NEPHROID_BENDING == 0 || (sides.n_near == sides.n_far && !coated)) { // one hides the other, or they are alike
    sample->direction = path->direction;
    sample->transmitted = sample->straight = true;
    sample->reflectance = 0.0f;
    sample->n_ratio = 1.0f;
  } else
    *sample = scatter_at(path->direction, surface, sides.n_near, sides.n_far, coating, u);
  sample->near_material = material_number(world, sides.near_object);
  sample->far_material = material_number(world, sides.far_object);
  if (sides.near_object != sides.far_object)
    split(world, path, sample->near_material, sample->far_material);
  if (!sample->transmitted) return true;
  path->media = sides.beyond;
  sample->n_ratio = sides.n_near / sides.n_far;
  if (sample->near_material != sample->far_material) pass_tint(world, path, at, band);
  return true;
}

MATERIAL_WITHOUT_BASE(dielectric)
