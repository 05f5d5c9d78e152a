// SPDX-License-Identifier: Apache-2.0
// A path from the eye through glass and mirrors to the first diffuse lobe, or out of the scene, in one band. It takes
// one way at each surface, by chance; branches.h goes all ways.
#include "kernels/transport/eye_path.h"
#include "kernels/transport/scatter_path.h"

#define BEFORE_THE_PATH 0xffffu // the surface's number in random numbers, where its lobe is given

typedef struct {
  Band band;
  uint2 seed;
  uint sample, paths, pixel, stream; // of eye_numbers
  bool likelier;                     // it takes the likelier of reflection and refraction, for a preview
  uint first_lobes;                  // what it takes at its first surface, which counts as none; 0: all, by chance
  bool drops_one_way;                // it ends where that surface leaves it no choice
  float share;                       // of the radiance at that surface, in those lobes
  float radiance_scale;              // beyond: of the radiance at its end, because it keeps radiance over n^2
  SET_ASIDE float4 u;
} Visitor;

static inline Visitor eye_visitor(const Band* band, uint2 seed, uint sample, uint paths, uint pixel, uint stream) {
  Visitor visitor;
  visitor.band = *band;
  visitor.seed = seed;
  visitor.sample = sample;
  visitor.paths = paths;
  visitor.pixel = pixel;
  visitor.stream = stream;
  visitor.likelier = visitor.drops_one_way = false;
  visitor.first_lobes = 0u;
  visitor.share = visitor.radiance_scale = 1.0f;
  visitor.u = (float4)(0.0f);
  return visitor;
}

static inline Band visitor_band(const Visitor* eye) { return eye->band; }

static inline WalkNumbers visitor_numbers(Visitor* eye, const Interaction* at, int n) {
  if (n >= 0 && (n & 3) == 0)
    eye->u = eye->likelier ? (float4)(0.5f)
                           : eye_numbers(eye->seed, eye->sample, n == 0 ? eye->paths : 0u, eye->pixel,
                                         1u + (uint)n / 4u, eye->stream);
  const float4 u = eye->u;
  if (n >= 0) eye->u = u.yzwx;
  const WalkNumbers numbers = {
      u.x, microfacet_numbers(eye->seed, eye->sample, eye->pixel, n < 0 ? BEFORE_THE_PATH : (uint)n, eye->stream)};
  return numbers;
}

static inline uint visitor_lobes(const Visitor* eye, const Interaction* at, int n) {
  return n < 0 ? eye->first_lobes : LOBES_ALL;
}

// A mirror, total reflection and glass that does not bend leave one way.
static inline bool leaves_one_way(const ScatterSample* sample) {
  return sample->reflectance == 0.0f || sample->reflectance == 1.0f;
}

static inline bool visit_scatter(const World* world, Visitor* eye, const Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  const float n_ratio = sample->n_ratio;
  if (n < 0) {
    eye->share = (sample->transmitted ? 1.0f - sample->reflectance : sample->reflectance) * n_ratio * n_ratio;
    return !(eye->drops_one_way && leaves_one_way(sample));
  }
  eye->radiance_scale *= n_ratio * n_ratio;
  return true;
}

#define WALK_LOBES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// Takes a path, which has met *hit, on to its end. Returns the factor of the radiance there, 0 where it is lost. *hit
// and *at become those of its end; where it leaves the scene, *hit has no primitive. *last: its last surface's number.
IN_PLACE float follow_eye_path(const World* world, Visitor* eye, Path* path, Hit* hit, Interaction* at, int* last) {
  const int how = walk(world, eye, path, hit, true, eye->first_lobes != 0u ? -1 : 0, at, last);
  if (eye->first_lobes == LOBE_DIFFUSE) eye->share = part_to_base(world, &at->surface, path->direction);
  return how == WALK_LOST || how == WALK_DROPPED ? 0.0f : eye->share * eye->radiance_scale;
}

// The same to a diffuse lobe only: 0 where the path leaves the scene.
IN_PLACE float reach_base(const World* world, Visitor* eye, Path* path, Hit* hit, Interaction* at) {
  int last;
  const float radiance_scale = follow_eye_path(world, eye, path, hit, at, &last);
  return hit->primitive == NEPHROID_NO_PRIMITIVE ? 0.0f : radiance_scale;
}
