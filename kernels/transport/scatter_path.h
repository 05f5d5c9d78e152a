// SPDX-License-Identifier: Apache-2.0
// A path goes on from a surface.
#include "kernels/scatter/scatter.h"
#include "kernels/transport/differential.h"

typedef struct {
  float u;             // in [0, 1): chooses the lobe
  float2 u_microfacet; // microfacet_numbers
} WalkNumbers;

// Sends a path on by the lobes that are wanted (sample_scatter). False: it is lost.
IN_PLACE bool scatter_path(const World* world, Path* path, const Interaction* at, const Band* band, uint lobes,
                           WalkNumbers numbers, ScatterSample* sample) {
  const bool from_outside = dot(path->direction, at->surface.geometric) < 0.0f;
  if (!sample_scatter(world, path, at, band, lobes, numbers.u, numbers.u_microfacet, sample)) return false;
  scatter_differentials(world, path, at, band, sample);
  path->direction = sample->direction;
  path->origin = start_on_side(&at->surface, from_outside == sample->transmitted ? -1.0f : 1.0f);
  path->skip = at->triangle;
  path->behind = 0.0f;
  return true;
}

// The lobes of a surface that a path takes among those that are wanted; 0: none. What has no diffuse lobe sends every
// path on: one that wants to pass a mirror is reflected.
static inline uint lobes_taken(const World* world, float3 arriving, const Interaction* at, uint wanted,
                               WalkNumbers numbers) {
  const uint lobes = lobes_of(&at->material), allowed = lobes & wanted;
  if (allowed == 0u) return (lobes & LOBE_DIFFUSE) != 0u ? 0u : lobes;
  if (allowed == LOBE_DIFFUSE || (allowed & LOBE_DIFFUSE) == 0u) return allowed;
  return choose_lobes(world, arriving, at, numbers.u, numbers.u_microfacet);
}
