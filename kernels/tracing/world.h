// SPDX-License-Identifier: Apache-2.0
// All of the scene that a path meets, in one struct.
#include "kernels/tracing/attenuation.h"
#include "kernels/tracing/band.h"
#include "kernels/tracing/media.h"
#include "kernels/tracing/registers.h"
#include "kernels/lights/sky.h"
#include "kernels/tracing/surface.h"

typedef struct {
  Geometry geometry;
  OBJECT_TABLES(TABLE_MEMBER)
  SpectralTables tables;
  STRETCH_TABLES(TABLE_MEMBER)
  Sky sky; // empty where no environment is a light
  TEXTURE_TABLES(TABLE_MEMBER)
  LAMP_TABLES(TABLE_MEMBER)
  TARGET_TABLES(TABLE_MEMBER)
  COLOUR_TABLES(TABLE_MEMBER)
  DeviceScene scene;
} World;

// The arguments of a kernel in the scene, and its World.
#define WORLD_ARGUMENTS __global const uchar *geometry, __global const uchar *tables, DeviceScene scene
#define WORLD \
  {{GEOMETRY_TABLES(TABLE_IN_GEOMETRY) scene.root}, OBJECT_TABLES(TABLE_IN_TABLES) \
   {WAVELENGTH_TABLES(TABLE_IN_TABLES)}, STRETCH_TABLES(TABLE_IN_TABLES) \
   {SKY_TABLES(TABLE_IN_TABLES) scene.sky_size}, TEXTURE_TABLES(TABLE_IN_TABLES) LAMP_TABLES(TABLE_IN_TABLES) \
   TARGET_TABLES(TABLE_IN_TABLES) COLOUR_TABLES(TABLE_IN_TABLES) scene}

static inline DeviceMaterial material_of(const World* world, int object) {
  return world->materials[world->objects[object].material];
}

// [material]: the index of refraction.
static inline __global const float* index_of_band(const World* world, const Band* band) {
#if NEPHROID_JITTER
  if (band->wavelength >= 0) return world->tables.index_of_wavelength + band->wavelength * world->scene.material_count;
#endif
  return world->tables.index_of_cluster + band->cluster * world->scene.material_count;
}

// The band of a path in a cluster. light: where its light comes from, or light_count for a path that any light may
// reach. u: in [0, 1), picks a wavelength by the worth of the light (app/tracing/scales.h).
COMPILED_ONCE Band choose_band(const World* world, int light, int cluster, float u) {
#if NEPHROID_JITTER
  const int first = world->tables.cluster_first[cluster], count = world->tables.cluster_first[cluster + 1] - first;
  const int members = world->tables.cluster_first[world->scene.cluster_count];
  return wavelength_of_cluster(cluster, world->tables.cluster_wavelengths + first,
                               world->tables.wavelength_cdf + light * members + first, count, u);
#else
  return whole_cluster(cluster);
#endif
}
