// SPDX-License-Identifier: Apache-2.0
// All of the scene that a path meets, in one struct, and how a path goes through it.
#include "kernels/tracing/attenuation.h"
#include "kernels/tracing/band.h"
#include "kernels/tracing/differential.h"
#include "kernels/tracing/interface.h"
#include "kernels/materials/conductor.h"
#include "kernels/materials/rough.h"
#include "kernels/tracing/registers.h"
#include "kernels/lights/sky.h"

#ifndef NEPHROID_MIRRORS
#define NEPHROID_MIRRORS 1
#endif

// 0: no surface of glass has a tint.
#ifndef NEPHROID_TINTS
#define NEPHROID_TINTS 1
#endif

// 1: paths from the eye find the even light of the environment where glass sends it (sky.h), and photons only its
// peaks.
#ifndef NEPHROID_EVEN_SKY
#define NEPHROID_EVEN_SKY 0
#endif

typedef struct {
  Geometry geometry;
  OBJECT_TABLES(TABLE_MEMBER)
  SpectralTables tables;
  STRETCH_TABLES(TABLE_MEMBER)
  Sky sky; // empty where no environment is a light
  TEXTURE_TABLES(TABLE_MEMBER)
  LAMP_TABLES(TABLE_MEMBER)
  DeviceScene scene;
} World;

#define WORLD_ARGUMENTS WORLD_TABLES(TABLE_ARGUMENT) DeviceScene scene
#define WORLD \
  {{GEOMETRY_TABLES(TABLE_VALUE) scene.root}, OBJECT_TABLES(TABLE_VALUE) {WAVELENGTH_TABLES(TABLE_VALUE)}, \
   STRETCH_TABLES(TABLE_VALUE) {SKY_TABLES(TABLE_VALUE) scene.sky_size}, \
   TEXTURE_TABLES(TABLE_VALUE) LAMP_TABLES(TABLE_VALUE) scene}

// 1: paths carry how they move with the place in the lattice or in the pixel that they start from.
#ifndef NEPHROID_PLACE_DIFFERENTIALS
#define NEPHROID_PLACE_DIFFERENTIALS 0
#endif

typedef struct {
  float3 origin, direction;
  uint skip;   // the triangle that the path leaves
  Media media; // the media that enclose it
  Losses losses;
  float behind; // the path begins this far behind `origin` (Emission); 0 after its first hit
  Differential differential;
#if NEPHROID_PLACE_DIFFERENTIALS
  // A prime is the derivative by the first, the second coordinate: in the lattice's square, or in pixels to the right
  // and down.
  Differential by_place[2];
#endif
} Path;

// 1: the camera has a lens, a shift or parallel rays. 0: it is a pinhole with its axis in the middle of the picture.
#ifndef NEPHROID_LENS
#define NEPHROID_LENS 0
#endif

#if NEPHROID_LENS
// The pinhole that a camera is at a place of its lens: it sees the same in the plane of focus. The lens's picture is
// the mean of theirs. lens: uniform in [0, 1) x [0, 1).
static inline DeviceCamera through_lens(const DeviceCamera* camera, float2 lens) {
  DeviceCamera pinhole = *camera;
  const float radius = camera->lens_radius * sqrt(lens.x);
  float cosine;
  const float sine = sincos(2.0f * PI_F * lens.y, &cosine), aside = radius * cosine, upwards = radius * sine;
  pinhole.position.xyz += aside * camera->right.xyz + upwards * camera->up.xyz;
  pinhole.shift_x -= aside / camera->focus;
  pinhole.shift_y -= upwards / camera->focus;
  return pinhole;
}
#endif

// direction: unit, along forward + x right + y up, so its derivative by x is (right - (right.D) D) (forward.D).
static inline Path path_from_eye(const DeviceCamera* camera, float3 direction) {
  Path path = {camera->position.xyz, direction, NEPHROID_NO_PRIMITIVE, camera->inside, no_losses(), 0.0f};
#if NEPHROID_PLACE_DIFFERENTIALS
  const float along = dot(direction, camera->forward.xyz);
  const float3 right = camera->right.xyz, up = camera->up.xyz;
  path.by_place[0].position = path.by_place[1].position = (float3)(0.0f);
  path.by_place[0].direction =
      2.0f * camera->tan_x / (float)camera->width * along * (right - dot(right, direction) * direction);
  path.by_place[1].direction =
      -2.0f * camera->tan_y / (float)camera->height * along * (up - dot(up, direction) * direction);
#if NEPHROID_LENS
  if (camera->orthographic) {
    path.by_place[0].position = 2.0f * camera->tan_x / (float)camera->width * right;
    path.by_place[1].position = -2.0f * camera->tan_y / (float)camera->height * up;
    path.by_place[0].direction = path.by_place[1].direction = (float3)(0.0f);
  }
#endif
#endif
  return path;
}

static inline Hit next_hit(const World* world, Path* path) {
  SET_ASIDE ulong latest = path->media.latest, earlier = path->media.earlier;
  const Hit hit = closest_hit(world->geometry.nodes, world->geometry.blocks, world->geometry.root, path->origin,
                              path->direction, -path->behind, INFINITY, path->skip);
  path->media.latest = latest;
  path->media.earlier = earlier;
  return hit;
}

static inline bool is_blocked(const World* world, float3 from, float3 direction, float distance, uint skip) {
  return any_hit(world->geometry.nodes, world->geometry.blocks, world->geometry.root, from, direction, distance, skip);
}

static inline DeviceMaterial material_of(const World* world, int object) {
  return world->materials[world->objects[object].material];
}

#include "kernels/materials/plastic.h"
#include "kernels/materials/texture.h"

// Adds the absorption of the medium that the path crosses up to its next hit, `distance` from its origin.
static inline void lose_in_medium(const World* world, Path* path, float distance) {
#if NEPHROID_ATTENUATORS > 0
  const int medium = medium_object(&path->media, world->objects);
  if (medium >= 0)
    lose(&path->losses, material_of(world, medium).attenuator,
         (path->behind + distance) * world->scene.metres_per_unit);
#endif
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

// Carries the path's derivatives to a surface and across the bend there, before `path` itself goes on.
static inline void bend_differential(const World* world, Path* path, uint triangle, const Surface* surface,
                                     const Band* band, const Bend* bend) {
  const float distance = dot(surface->position - path->origin, path->direction);
#if NEPHROID_PLACE_DIFFERENTIALS
  for (int i = 0; i < 2; ++i) {
    differential_to_surface(&path->by_place[i], path->direction, distance, surface);
    if (bend->straight) continue;
    __global const float* n_of = index_of_band(world, band);
    const int near = bend->near_material, far = bend->far_material;
    differential_through_bend(&path->by_place[i], &world->geometry, triangle, surface, path->direction, bend,
                              near < 0 ? 1.0f : n_of[near], far < 0 ? 1.0f : n_of[far], 0.0f, 0.0f);
  }
#endif
#if NEPHROID_DIFFERENTIALS
  differential_to_surface(&path->differential, path->direction, distance, surface);
  if (bend->straight) return;
  __global const float* n_of = index_of_band(world, band);
  __global const float* slope_of = world->index_slope + band->cluster * world->scene.material_count;
  const int near = bend->near_material, far = bend->far_material;
  differential_through_bend(&path->differential, &world->geometry, triangle, surface, path->direction, bend,
                            near < 0 ? 1.0f : n_of[near], far < 0 ? 1.0f : n_of[far], near < 0 ? 0.0f : slope_of[near],
                            far < 0 ? 0.0f : slope_of[far]);
#endif
}

// The coating of a dielectric for the wavelength of a band.
static inline Layer layer_of(const World* world, const DeviceMaterial* material, const Band* band) {
  Layer layer = no_layer();
#if NEPHROID_COATINGS
  if (material->surface_first >= 0) {
    const int wavelength = max(band->wavelength, 0); // the plan gives every path one
    layer.n = world->tables.surface_data[material->surface_first + wavelength];
    layer.thickness = material->coating_nm / (float)(380 + wavelength);
  }
#endif
  return layer;
}

static inline void lose_at_mirror(const World* world, Path* path, const DeviceMaterial* material, const Band* band,
                                  float cos_i) {
#if NEPHROID_CONDUCTORS
  if (material->surface_first >= 0) {
    const int around = medium_object(&path->media, world->objects);
    lose_in_conductor(&path->losses, material->attenuator, world->tables.surface_data + material->surface_first, cos_i,
                      around < 0 ? 1.0f : index_of_band(world, band)[world->objects[around].material]);
    return;
  }
#endif
  lose(&path->losses, material->attenuator, 1.0f);
}

// Takes away what a rough surface masks of a path that it has bent, before the path goes on. facet: unit, where it was
// bent; n: the surface's own normal on that side.
static inline void lose_by_masking(Path* path, const DeviceMaterial* material, const Bend* bend, float3 facet,
                                   float3 n) {
  if (bend->straight) return;
  // bend_at_surface takes the triangle's own normal where the facet sends the path to the wrong side.
  const float left = any(bend->normal != facet) ? 0.0f : unmasked(path->direction, bend, n, material->alpha);
  lose(&path->losses, material->masking, left > 0.0f ? -log(left) : 200.0f);
}

// bend_path_as about the shading normal of `bent_at`, without what roughness takes.
static inline bool bend_about(const World* world, Path* path, uint triangle, const Surface* bent_at,
                              const DeviceMaterial* material, const Band* band, float choice, float* n_ratio,
                              Bend* bend) {
  *n_ratio = 1.0f;
#if NEPHROID_MIRRORS
  if (material->type == MATERIAL_MIRROR || material->type == MATERIAL_CONDUCTOR) {
    *bend = bend_at_surface(path->direction, bent_at, 1.0f, 1.0f, no_layer(), -1.0f);
    bend->reflectance = 1.0f;
    lose_at_mirror(world, path, material, band, -dot(path->direction, bend->normal));
    return true;
  }
#endif
  if (is_plastic(material)) { // its coat; what passes that ends at the base (ends_at)
    *bend = bend_at_surface(path->direction, bent_at, 1.0f, coat_index(world, material), no_layer(), -1.0f);
    return true;
  }
  if (!cross_interface(&path->media, bent_at, world->objects, index_of_band(world, band), material,
                       layer_of(world, material, band), path->direction, choice, bend, n_ratio))
    return false;
#if NEPHROID_TINTS
  if (bend->transmitted && (material->is_thin || bend->near_material != bend->far_material)) {
    lose(&path->losses, material->tint, 1.0f);
#if NEPHROID_TINT_TEXTURES
    if (material->texture >= 0) {
      const float part = tint_at(world, material, bent_at, triangle, max(band->wavelength, 0)); // as layer_of
      lose(&path->losses, material->masking, part > 0.0f ? -log(part) : 200.0f);
    }
#endif
  }
#endif
  return true;
}

// Continues the path at a mirror, a coat or a dielectric. choice: uniform in [0, 1); -1 reflects, as coats always do; 2
// goes through where anything does. facet_choice: facet_numbers. *n_ratio, false: as in cross_interface. *bend: what
// happened there.
IN_PLACE bool bend_path_as(const World* world, Path* path, uint triangle, const Surface* surface,
                           const DeviceMaterial* material, const Band* band, float choice, float2 facet_choice,
                           float* n_ratio, Bend* bend) {
  const bool from_outside = dot(path->direction, surface->geometric) < 0.0f;
#if NEPHROID_ROUGH
  const float side = from_outside ? 1.0f : -1.0f;
  const float3 n = normal_before(path->direction, surface);
  Surface facet = *surface;
  if (material->alpha > 0.0f) facet.shading = side * visible_facet(-path->direction, n, material->alpha, facet_choice);
  if (!bend_about(world, path, triangle, &facet, material, band, choice, n_ratio, bend)) return false;
  if (material->alpha > 0.0f) lose_by_masking(path, material, bend, side * facet.shading, n);
#else
  if (!bend_about(world, path, triangle, surface, material, band, choice, n_ratio, bend)) return false;
#endif
  bend_differential(world, path, triangle, surface, band, bend);
  path->direction = bend->direction;
  path->origin = start_on_side(surface, from_outside == bend->transmitted ? -1.0f : 1.0f);
  path->skip = triangle;
  path->behind = 0.0f;
  return true;
}

static inline bool bend_path(const World* world, Path* path, uint triangle, const Surface* surface,
                             const DeviceMaterial* material, const Band* band, float choice, float2 facet_choice,
                             float* n_ratio) {
  Bend bend;
  return bend_path_as(world, path, triangle, surface, material, band, choice, facet_choice, n_ratio, &bend);
}

#include "kernels/lights/spectrum.h"
