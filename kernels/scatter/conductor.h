// SPDX-License-Identifier: Apache-2.0
// What a metal reflects: Fresnel's equations with a complex index n + i k (Born and Wolf, Principles of Optics, 14.2),
// at each of the wavelengths that carry the path's light.
#include "kernels/scatter/interaction.h"

// Mean of the reflectances of both polarisations. n, k: of the metal, over the index of the medium before it.
static inline float conductor_reflectance(float cos_i, float n, float k) {
  const float cos2 = cos_i * cos_i, sin2 = (1.0f - cos_i) * (1.0f + cos_i);
  const float difference = n * n - k * k - sin2, product = n * k;
  const float length = sqrt(difference * difference + 4.0f * product * product); // a^2 + b^2, with (a + i b)^2 =
  const float a = sqrt(fmax(0.5f * (length + difference), 0.0f));                //   (n + i k)^2 - sin^2
  const float along = 2.0f * a * cos_i, s = (length + cos2 - along) / (length + cos2 + along);
  const float both = cos2 * length + sin2 * sin2, across = along * sin2;
  return 0.5f * s * (1.0f + (both - across) / (both + across));
}

// The material that a path is in; -1: air.
static inline int material_around(const World* world, const Path* path) {
  const int object = medium_object(&path->media, world->objects);
  return object < 0 ? -1 : world->objects[object].material;
}

// Its index of refraction at a wavelength.
static inline float index_around(const World* world, const Band* band, int around, int wavelength) {
  return around < 0                                 ? 1.0f
         : NEPHROID_JITTER && band->wavelength >= 0 ? index_of_wavelength(world, wavelength)[around]
                                                    : index_of_cluster(world, band->cluster)[around];
}

// At a wavelength. around: material_around.
static inline float conductor_part(const World* world, const DeviceMaterial* material, const Band* band, int around,
                                   float cos_i, int wavelength) {
  __global const float* n_and_k = world->tables.surface_data + material->surface_first + 2 * wavelength;
  const float n_near = index_around(world, band, around, wavelength);
  return conductor_reflectance(cos_i, n_and_k[0] / n_near, n_and_k[1] / n_near);
}

#if NEPHROID_LOSSES
#define METAL_TAKES(word) \
  const int around = material_around(world, path); \
  const float cos_i = -dot(path->direction, sample->normal); \
  LEAVE_BY_WAVELENGTH(&path->throughput, band, word##_parts(world, &at->material, band, around, cos_i, carriers))
#else
#define METAL_TAKES(word)
#endif

// The verbs of a metal: METAL(conductor) makes them of conductor_part, its reflectance at a wavelength.
#define METAL(word) \
  static inline Parts word##_parts(const World* world, const DeviceMaterial* material, const Band* band, int around, \
                                   float cos_i, const Carriers* carriers) { \
    const int4 w = carriers->wavelengths; \
    const Parts parts = {(float4)(word##_part(world, material, band, around, cos_i, w.x), \
                                  word##_part(world, material, band, around, cos_i, w.y), \
                                  word##_part(world, material, band, around, cos_i, w.z), \
                                  word##_part(world, material, band, around, cos_i, w.w)), \
                         word##_part(world, material, band, around, cos_i, carriers->middle)}; \
    return parts; \
  } \
  static inline bool word##_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u, \
                                    ScatterSample* sample) { \
    *sample = reflect_at(path->direction, &at->surface, 1.0f, 1.0f); \
    sample->reflectance = 1.0f; \
    METAL_TAKES(word) \
    return true; \
  } \
  MATERIAL_WITHOUT_BASE(word)

METAL(conductor)
