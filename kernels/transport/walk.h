// SPDX-License-Identifier: Apache-2.0
// The one loop: a path goes from surface to surface, through media, and is scattered, until it leaves the scene, ends
// at a diffuse lobe or is lost. Photons, tiles, paths from the eye, light between walls and bakes all take it. What a
// stage does on the way is its Visitor, which it defines before it includes this file:
//
//   Band visitor_band(visitor)                              the wavelengths of the path
//   WalkNumbers visitor_numbers(visitor, at, n)             the random numbers of surface n
//
// and, where it defines the word before, also
//
//   WALK_SEGMENTS  visit_segment(world, visitor, path, hit)  each way, up to a hit or out of the scene
//   WALK_SURFACES  visit_surface(world, visitor, path, at, n)   each surface, before the path is scattered
//   WALK_LOBES     uint visitor_lobes(visitor, at, n)       which lobes the path may take; else all
//   WALK_BASES     bool visit_base(world, visitor, path, at, n)  a diffuse lobe; true: the path goes on from there, in
//                                                           a direction that the visitor gives it
//   WALK_SCATTERS  bool visit_scatter(world, visitor, path, at, sample, n)  the path has been scattered; false: dropped
#include "kernels/transport/scatter_path.h"

// How a walk ends.
#define WALK_LEFT 0    // out of the scene
#define WALK_AT_BASE 1 // at a diffuse lobe
#define WALK_LOST 2    // after scene.max_surfaces, in more than MEDIA_DEPTH media, or where no wanted lobe is
#define WALK_DROPPED 3 // by the visitor

// Takes a path from surface `first` on to its end. known: its next hit is *hit. *hit and *at become those of its last
// surface, *surface_number that surface's number. Returns WALK_*.
IN_PLACE int walk(const World* world, Visitor* visitor, Path* path, Hit* hit, bool known, int first, Interaction* at,
                  int* surface_number) {
  for (int n = first;; ++n) {
    *surface_number = n;
    if (n > first || !known) *hit = next_hit(world, path);
#ifdef WALK_SEGMENTS
    visit_segment(world, visitor, path, hit);
#endif
    if (hit->primitive == NEPHROID_NO_PRIMITIVE) return WALK_LEFT;
    *at = interaction_at(world, *hit);
    const Band band = visitor_band(visitor);
    cross_medium(world, path, &band, hit->t);
#ifdef WALK_SURFACES
    visit_surface(world, visitor, path, at, n);
#endif
    uint wanted = LOBES_ALL;
#ifdef WALK_LOBES
    wanted = visitor_lobes(visitor, at, n);
#endif
    WalkNumbers numbers = {0.0f, (float2)(0.0f)};
    if (!is_only_matt(&at->material)) numbers = visitor_numbers(visitor, at, n);
    const uint lobes = lobes_taken(world, path->direction, at, wanted, numbers);
    if (lobes == LOBE_DIFFUSE) {
#ifdef WALK_BASES
      if (!visit_base(world, visitor, path, at, n)) return WALK_AT_BASE;
#else
      return WALK_AT_BASE;
#endif
    }
    if (lobes == 0u || n >= world->scene.max_surfaces) return WALK_LOST;
    if (lobes == LOBE_DIFFUSE) continue;
    ScatterSample sample;
    if (!scatter_path(world, path, at, &band, lobes, numbers, &sample)) return WALK_LOST;
#ifdef WALK_SCATTERS
    if (!visit_scatter(world, visitor, path, at, &sample, n)) return WALK_DROPPED;
#endif
  }
}
