// SPDX-License-Identifier: Apache-2.0
// Plastic, varnish, glaze: a matt base under a polished or rough coat without colour. The coat reflects a part of the
// light, by Fresnel's equations at its microfacets. The rest reaches the base and is scattered there. The base has the
// row's albedo times the part that passes the coat on the way in, times the part that passes on the way out; the row
// makes up for what these keep of light from all sides (app/optics/coat.h).
#include "kernels/scatter/interaction.h"

static inline float coat_index(const World* world, const DeviceMaterial* material) {
  return world->tables.surface_data[material->surface_first];
}

// Its coat; what passes that goes to the base.
static inline bool plastic_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                   ScatterSample* sample) {
  *sample = reflect_at(path->direction, &at->surface, 1.0f, coat_index(world, &at->material));
  return true;
}

// The part that the coat reflects.
static inline float plastic_coat_reflectance(const World* world, const DeviceMaterial* material, float cos_i) {
  const float n = coat_index(world, material);
  return fresnel_reflectance(cos_i, refracted_cosine(cos_i, 1.0f / n), 1.0f, n);
}

// The part of light that passes the coat on its way to the base, or from there. cosine: of the way.
static inline float plastic_part_to_base(const World* world, const DeviceMaterial* material, float cosine) {
  __global const float* parts = world->tables.surface_data + material->surface_first + COAT_PARTS;
  const float place = cosine * (float)(COAT_COSINES - 1);
  const int before = clamp((int)place, 0, COAT_COSINES - 2);
  return mix(parts[before], parts[before + 1], place - (float)before);
}
