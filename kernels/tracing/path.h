// SPDX-License-Identifier: Apache-2.0
// A path's last way: where it goes, what encloses it, what is left of its light.
#include "kernels/tracing/world.h"

// 1: paths carry how they move with the place in the lattice or in the pixel that they start from.
#ifndef NEPHROID_PLACE_DIFFERENTIALS
#define NEPHROID_PLACE_DIFFERENTIALS 0
#endif

typedef struct {
  float3 origin, direction;
  uint skip;   // the triangle that the path leaves
  Media media; // the media that enclose it
  Throughput throughput;
  float behind; // the path begins this far behind `origin` (Emission); 0 after its first hit
  Differential differential;
#if NEPHROID_PLACE_DIFFERENTIALS
  // A prime is the derivative by the first, the second coordinate: in the lattice's square, or in pixels to the right
  // and down.
  Differential by_place[2];
#endif
} Path;

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

// Absorption in the medium that the path crosses up to its next hit, `distance` from its origin.
static inline void cross_medium(const World* world, Path* path, const Band* band, float distance) {
#if NEPHROID_LOSSES
  const int medium = medium_object(&path->media, world->objects);
  if (medium >= 0)
    attenuate(&world->tables, &path->throughput, band, material_of(world, medium).attenuator,
              (path->behind + distance) * world->scene.metres_per_unit);
#endif
}
