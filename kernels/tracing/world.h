// SPDX-License-Identifier: Apache-2.0
// All of the scene that a path meets, in one struct.
#include "kernels/lights/light_types.h"
#include "kernels/tracing/media.h"
#include "kernels/tracing/registers.h"
#include "kernels/tracing/sky_tables.h"
#include "kernels/tracing/surface.h"
#include "kernels/tracing/throughput.h"

// 0: splats are points, and the differentials of wavelengths compile to nothing.
#ifndef NEPHROID_DIFFERENTIALS
#define NEPHROID_DIFFERENTIALS 1
#endif

typedef struct {
  Geometry geometry;
  OBJECT_TABLES(TABLE_MEMBER)
  SpectralTables tables;
  STRETCH_TABLES(TABLE_MEMBER)
  Sky sky; // empty where no environment is a light
  TEXTURE_TABLES(TABLE_MEMBER)
  LAMP_TABLES(TABLE_MEMBER)
  METER_TABLES(TABLE_MEMBER)
  TARGET_TABLES(TABLE_MEMBER)
  COLOUR_TABLES(TABLE_MEMBER)
  DeviceScene scene;
} World;

// The arguments of a kernel in the scene, and its World.
#define WORLD_ARGUMENTS __global const uchar *geometry, __global const uchar *tables, DeviceScene scene
#define WORLD_NAMES geometry, tables, scene
#define WORLD \
  {{GEOMETRY_TABLES(TABLE_IN_GEOMETRY) scene.root}, OBJECT_TABLES(TABLE_IN_TABLES) \
   {WAVELENGTH_TABLES(TABLE_IN_TABLES)}, STRETCH_TABLES(TABLE_IN_TABLES) \
   {SKY_TABLES(TABLE_IN_TABLES) scene.sky_size}, TEXTURE_TABLES(TABLE_IN_TABLES) LAMP_TABLES(TABLE_IN_TABLES) \
   METER_TABLES(TABLE_IN_TABLES) TARGET_TABLES(TABLE_IN_TABLES) COLOUR_TABLES(TABLE_IN_TABLES) scene}

static inline DeviceMaterial material_of(const World* world, int object) {
  return world->materials[world->objects[object].material];
}

// [material]: the index of refraction.
static inline __global const float* index_of_cluster(const World* world, int cluster) {
  return world->tables.index_of_cluster + cluster * world->scene.material_count;
}
static inline __global const float* index_of_wavelength(const World* world, int wavelength) {
  return world->tables.index_of_wavelength + wavelength * world->scene.material_count;
}

// For the way that a path goes.
static inline __global const float* index_of_band(const World* world, const Band* band) {
  return NEPHROID_JITTER && band->wavelength >= 0 ? index_of_wavelength(world, band->wavelength)
                                                  : index_of_cluster(world, band->cluster);
}

// A wavelength of a cluster, by the worth of the light (app/tracing/scales.h). light: where it comes from, or
// light_count for a path that any light may reach. u: in [0, 1).
COMPILED_ONCE DrawnWavelength draw_wavelength(const World* world, int light, int cluster, float u) {
  const int first = world->tables.cluster_first[cluster], count = world->tables.cluster_first[cluster + 1] - first;
  const int members = world->tables.cluster_first[world->scene.cluster_count];
  return wavelength_of_cluster(world->tables.cluster_wavelengths + first,
                               world->tables.wavelength_cdf + light * members + first, count, u);
}

// The band of a path in a cluster. light, u: as in draw_wavelength.
static inline Band choose_band(const World* world, int light, int cluster, float u) {
  Band band = whole_cluster(cluster);
#if NEPHROID_JITTER || NEPHROID_LOSSES
  const DrawnWavelength leader = draw_wavelength(world, light, cluster, u);
#if NEPHROID_JITTER
  band = one_wavelength(cluster, leader.wavelength, leader.weight);
#endif
#if NEPHROID_LOSSES && (!NEPHROID_JITTER || NEPHROID_DIFFERENTIALS)
  band.own = carriers_of(leader, draw_wavelength(world, light, cluster, quarters_on(u, 1)),
                         draw_wavelength(world, light, cluster, quarters_on(u, 2)),
                         draw_wavelength(world, light, cluster, quarters_on(u, 3)),
                         draw_wavelength(world, light, cluster, 0.5f).wavelength);
#endif
#endif
  return band;
}

// The cluster of a path from the eye, by its chance in cluster_cdf. place: in [0, 1). *within: where it lies there.
static inline int cluster_at(const World* world, float place, float* chance, float* within) {
  const int cluster = choose(world->cluster_cdf + 1, world->scene.cluster_count, place);
  const float before = world->cluster_cdf[cluster];
  *chance = world->cluster_cdf[cluster + 1] - before;
  *within = clamp((place - before) / *chance, 0.0f, 0x1.fffffep-1f);
  return cluster;
}

// A place in the spectrum of the eye, [0, 1]: by the chances of clusters, and in each of wavelengths, as any light may
// reach the eye.
typedef struct {
  int cluster, number; // of the member, in cluster_wavelengths
  float part;          // of the member that is before the place
  float chance;        // of the member
} Member;

COMPILED_ONCE Member member_at(const World* world, float place) {
  Member member;
  float chance, within;
  member.cluster = cluster_at(world, place, &chance, &within);
  const int first = world->tables.cluster_first[member.cluster],
            count = world->tables.cluster_first[member.cluster + 1] - first,
            members = world->tables.cluster_first[world->scene.cluster_count];
  __global const float* cdf = world->tables.wavelength_cdf + world->scene.light_count * members + first;
  const int in_cluster = choose(cdf, count, within);
  const float before = chance_before(cdf, in_cluster), of_cluster = cdf[in_cluster] - before;
  member.number = first + in_cluster;
  member.part = clamp((within - before) / of_cluster, 0.0f, 1.0f);
  member.chance = chance * of_cluster;
  return member;
}

// Its wavelength, drawn by the place. size: of the part of the spectrum in which that is uniform.
static inline DrawnWavelength wavelength_at(const World* world, float place, float size) {
  const Member member = member_at(world, fmin(place, 0x1.fffffep-1f));
  const DrawnWavelength drawn = {world->tables.cluster_wavelengths[member.number], size / member.chance};
  return drawn;
}
