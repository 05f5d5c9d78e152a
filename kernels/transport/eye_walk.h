// SPDX-License-Identifier: Apache-2.0
// A path from the eye through glass and mirrors to the first diffuse lobe, or out of the scene, in one band.
// With NEPHROID_HIGHLIGHTS rough surfaces add the light of lamps on the way.
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
  ScatterSample first;               // what happened at that surface
  SET_ASIDE float4 u;
#ifdef NEPHROID_HIGHLIGHTS
  float3 first_shine, shine; // light of lamps that rough surfaces send back: the first of first_lobes, and later ones
  bool by_microfacets;       // a rough surface scattered it last: what it meets of a lamp is in `shine`
#endif
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
#ifdef NEPHROID_HIGHLIGHTS
  visitor.first_shine = visitor.shine = (float3)(0.0f);
  visitor.by_microfacets = false;
#endif
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

#ifdef NEPHROID_HIGHLIGHTS
// The XYZ radiance of a lamp that a rough surface sends to the path which arrives there: reflected, or through the
// surface from beyond. paths: as in irradiance_of.
static inline float3 highlight(const World* world, int light_index, bool beyond, const Path* path,
                               const Interaction* at, const Band* band, uint2 seed, uint sample, uint paths,
                               uint pixel) {
  const Surface* surface = &at->surface;
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f, light_side = beyond ? -side : side;
  const float3 n = normal_before(path->direction, surface);
  const LightSample arrival =
      sample_lamp(world, light_index, surface->position, beyond ? -n : n, seed, sample, paths, pixel);
  if (!(arrival.irradiance > 0.0f) || !(light_side * dot(arrival.direction, surface->geometric) > 0.0f))
    return (float3)(0.0f);
  Path scattered = *path;
  const float part = evaluate_scatter(world, &scattered, at, band, arrival.direction, beyond);
  if (part == 0.0f || is_hidden(world, surface, start_on_side(surface, light_side), &arrival, at->triangle))
    return (float3)(0.0f);
  const Source lamp = {light_index, (float3)(1.0f)};
  return carried_light(world, &scattered.throughput, lamp, band, white_reflector()).xyz * (arrival.irradiance * part);
}

// The same of all lamps on both sides, where the surface is rough.
static inline void visit_surface(const World* world, Visitor* eye, const Path* path, const Interaction* at, int n) {
  if (!is_rough(&at->material) || (n < 0 && (eye->first_lobes & LOBE_REFLECTION) == 0u)) return;
  SET_ASIDE float3 xyz = (float3)(0.0f);
  const uint numbers = eye->pixel + 0x9e3779b9u * (1u + (uint)max(n, 0));
  const uint paths = max(eye->paths, 1u);
  for (int l = 0; l < world->scene.light_count; ++l)
    for (int beyond = 0; beyond < ((lobes_of(&at->material) & LOBE_TRANSMISSION) != 0u ? 2 : 1); ++beyond)
      if (!is_of_environment(world, l)) // which paths find
        xyz += highlight(world, l, beyond, path, at, &eye->band, eye->seed, eye->sample, paths, numbers);
  if (n < 0)
    eye->first_shine += xyz;
  else
    eye->shine += eye->radiance_scale * xyz;
}
#define WALK_SURFACES
#endif

// A mirror, total reflection and glass that does not bend leave one way.
static inline bool leaves_one_way(const ScatterSample* sample) {
  return sample->reflectance == 0.0f || sample->reflectance == 1.0f;
}

static inline bool visit_scatter(const World* world, Visitor* eye, const Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  const float n_ratio = sample->n_ratio;
#ifdef NEPHROID_HIGHLIGHTS
  eye->by_microfacets = is_rough(&at->material) && !sample->straight;
#endif
  if (n < 0) {
    eye->first = *sample;
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
