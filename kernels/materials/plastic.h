// SPDX-License-Identifier: Apache-2.0
// Plastic, varnish, glaze: a matt base under a polished or rough coat without colour. The coat reflects a part of the
// light, by Fresnel's equations at its facets (rough.h). The rest reaches the base and is scattered there. The base has
// the row's reflectance times the part that passes the coat on the way in, times the part that passes on the way out;
// the row makes up for what these keep of light from all sides (app/optics/coat.h).

// 0: no object is of plastic.
#ifndef NEPHROID_PLASTICS
#define NEPHROID_PLASTICS 1
#endif

static inline bool is_plastic(const DeviceMaterial* material) {
  return NEPHROID_PLASTICS && material->type == MATERIAL_PLASTIC;
}

static inline bool is_matt(const DeviceMaterial* material) {
  return material->type == MATERIAL_DIFFUSE || is_plastic(material);
}

static inline float coat_index(const World* world, const DeviceMaterial* material) {
  return world->tables.surface_data[material->surface_first];
}

// The part of light that passes the coat of a matt surface on its way to the base, or from there, along the unit
// vector `way`: 1 where there is no coat.
static inline float part_through_coat(const World* world, const Surface* surface, float3 way) {
#if NEPHROID_PLASTICS
  const DeviceMaterial material = material_of(world, surface->object);
  if (is_plastic(&material)) {
    __global const float* parts = world->tables.surface_data + material.surface_first + COAT_PARTS;
    const float place = fabs(dot(way, surface->shading)) * (float)(COAT_COSINES - 1);
    const int before = clamp((int)place, 0, COAT_COSINES - 2);
    return mix(parts[before], parts[before + 1], place - (float)before);
  }
#endif
  return 1.0f;
}

// Whether a path that arrives at a surface ends there: at a matt one, unless a coat reflects it. choice: uniform in
// [0, 1); -1: a coat reflects it. facet_choice: facet_numbers.
static inline bool ends_at(const World* world, float3 arriving, const Surface* surface, const DeviceMaterial* material,
                           float choice, float2 facet_choice) {
#if NEPHROID_PLASTICS
  if (is_plastic(material)) {
    float3 normal = normal_before(arriving, surface);
#if NEPHROID_ROUGH
    if (material->alpha > 0.0f) normal = visible_facet(-arriving, normal, material->alpha, facet_choice);
#endif
    const float cos_i = clamp(-dot(arriving, normal), 0.0f, 1.0f), n = coat_index(world, material);
    return choice >= 0.0f && !(choice < fresnel_reflectance(cos_i, refracted_cosine(cos_i, 1.0f / n), 1.0f, n));
  }
#endif
  return material->type == MATERIAL_DIFFUSE;
}

// Takes from a path that a coat has reflected what would have passed it.
static inline void lose_below_coat(Path* path, const DeviceMaterial* material, const Bend* bend) {
  lose(&path->losses, material->masking, bend->reflectance > 0.0f ? -log(bend->reflectance) : 200.0f);
}
