// SPDX-License-Identifier: Apache-2.0
// A path from the eye that divides: at glass it goes both ways, and at a coat to the base and back, as long as each is
// much of what its pixel shows.
#include "kernels/transport/eye_path.h"
#include "kernels/transport/scatter_path.h"

// 1: rough surfaces add the light of lamps on the way.
#ifndef NEPHROID_HIGHLIGHTS
#define NEPHROID_HIGHLIGHTS 0
#endif

// The part of a path's radiance below which a branch is not followed beside another.
#define LEAST_SHARE 0.005f
// By how much of its spread a path blurs highlights, as slopes of microfacets.
#define HIGHLIGHT_BLUR 0.7f
// How many branches of a path can wait to be followed.
#define EYE_PENDING 6

// A branch, up to its last surface.
typedef struct {
  Path path;
  float share; // of the path's radiance by Fresnel's equations, over the chance that the branch is followed
  float scale; // beyond: of radiance, because what glass keeps is radiance over n^2
  int surfaces;
  float spread;        // by rough surfaces: the angle, in radians, within which it stands for other ways
  bool by_microfacets; // a rough surface scattered it last: what it meets of a lamp is in `shine`
} EyeBranch;

// How a branch and those that wait are followed: the visitor of a walk.
typedef struct {
  Band band;
  EyeBranch branch, before; // now; at the surface that scatters it
  EyeBranch pending[EYE_PENDING];
  int waiting;
  uint2 seed;
  uint sample, paths, pixel, stream; // of eye_numbers
  uint number;                       // of random4: it is of no other path, however many those have
  uint met;                          // how many surfaces all branches have met
  WalkNumbers numbers;               // of the surface
  uint lobes;                        // that the branch may take there
  bool is_rough_there;
  float3 shine; // XYZ radiance of lamps that rough surfaces send back
} Visitor;

static inline Band visitor_band(const Visitor* eye) { return eye->band; }
static inline WalkNumbers visitor_numbers(const Visitor* eye, const Interaction* at, int n) { return eye->numbers; }
static inline uint visitor_lobes(const Visitor* eye, const Interaction* at, int n) { return eye->lobes; }
static inline void visit_surface(const World* world, Visitor* eye, const Path* path, const Interaction* at, int n);
static inline bool visit_scatter(const World* world, Visitor* eye, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n);

#define WALK_SURFACES
#define WALK_LOBES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// How many paths a sample has that meets this first: facets are left to chance.
static inline uint paths_through(const World* world, Hit first) {
  const Interaction at = interaction_at(world, first);
  return is_rough(&at.material) ? PATHS_THROUGH_GLASS : 1u;
}

// Begins path `i` of the `paths` of a frame.
static inline void begin_branches(Visitor* eye, const Path* path, const Band* band, uint2 seed, uint frame, uint i,
                                  uint paths, uint pixel, uint stream) {
  eye->band = *band;
  eye->branch.path = *path;
  eye->branch.share = eye->branch.scale = 1.0f;
  eye->branch.surfaces = eye->waiting = 0;
  eye->branch.spread = 0.0f;
  eye->seed = seed;
  eye->sample = frame * paths + i;
  eye->paths = paths;
  eye->number = frame * PATHS_THROUGH_GLASS + i;
  eye->pixel = pixel;
  eye->stream = stream;
  eye->met = 0u;
  eye->branch.by_microfacets = false;
  eye->shine = (float3)(0.0f);
}

// Follows the branch to its end. first: what the path meets first. Returns WALK_*; *last: its last surface's number.
IN_PLACE int follow_branch(const World* world, Visitor* eye, Hit* first, Interaction* at, int* last) {
  const int surfaces = eye->branch.surfaces;
  return walk(world, eye, &eye->branch.path, first, surfaces == 0, surfaces, at, last);
}

// Takes up a branch that waits. False: there is none.
static inline bool next_branch(Visitor* eye) {
  if (eye->waiting == 0) return false;
  eye->branch = eye->pending[--eye->waiting];
  return true;
}

// Decides which of the branch and its other way are followed from surface n: both at the first. Where one has little
// light, or there is no room for both, chance decides, and one stands for both.
static inline void choose_branches(Visitor* eye, EyeBranch* other, int n, bool* follows, bool* follows_other) {
  *follows = *follows_other = true;
  const float own = eye->branch.share, both = own + other->share;
  if (n == 0 || (fmin(own, other->share) >= LEAST_SHARE && eye->waiting < EYE_PENDING)) return;
  *follows = random4(eye->seed, eye->number, eye->pixel, 1u + eye->met, eye->stream).x * both < own;
  *follows_other = !*follows;
  eye->branch.share = other->share = both;
}

// The XYZ radiance of a lamp that a rough surface sends to the path which arrives there: reflected, or through the
// surface from beyond.
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

// The same of all lamps on both sides of a rough surface. After another rough surface a path stands for all ways within
// its spread, so it sees a highlight as far blurred as these; less so the more paths there are, by the power -1/6, so
// that noise and blur vanish alike (Kaplanyan and Dachsbacher 2013, "Path Space Regularization").
static inline float3 highlights(const World* world, const Visitor* eye, const Path* path, const Interaction* met) {
  const float blur = HIGHLIGHT_BLUR * eye->branch.spread *
                     pow(1.0f + (float)(eye->number / (NEPHROID_FILM_HALVES * PATHS_THROUGH_GLASS)), -1.0f / 6.0f);
  Interaction at = *met;
  at.material.alpha = sqrt(at.material.alpha * at.material.alpha + blur * blur);
  SET_ASIDE float3 xyz = (float3)(0.0f);
  const uint numbers = eye->pixel + 0x9e3779b9u * (1u + eye->met);
  for (int l = 0; l < world->scene.light_count; ++l)
    for (int beyond = 0; beyond < ((lobes_of(&at.material) & LOBE_TRANSMISSION) != 0u ? 2 : 1); ++beyond)
      if (!is_of_environment(world, l)) // which paths find
        xyz += highlight(world, l, beyond, path, &at, &eye->band, eye->seed, eye->sample, eye->paths, numbers);
  return xyz;
}

static inline void visit_surface(const World* world, Visitor* eye, const Path* path, const Interaction* at, int n) {
  eye->lobes = LOBE_DIFFUSE | LOBE_TRANSMISSION;
  if (is_only_matt(&at->material)) return;
  EyeBranch *branch = &eye->branch, *before = &eye->before;
  ++eye->met;
  eye->numbers.u = 0.0f; // nothing is left to chance but microfacets
  eye->numbers.u_microfacet = microfacet_numbers(eye->seed, eye->number, eye->pixel, eye->met, eye->stream);
  eye->is_rough_there = is_rough(&at->material);
  if (NEPHROID_HIGHLIGHTS && eye->is_rough_there)
    eye->shine += branch->share * branch->scale * highlights(world, eye, path, at);
  *before = *branch;
  if (!has_coat(&at->material)) return;
  // The branch goes to the base, and another one back.
  EyeBranch reflected = *branch;
  branch->share *= part_to_base(world, &at->surface, path->direction);
  ScatterSample sample;
  if (n >= world->scene.max_surfaces ||
      !scatter_path(world, &reflected.path, at, &eye->band, LOBE_REFLECTION, eye->numbers, &sample))
    return;
  reflected.share *= sample.reflectance;
  reflected.surfaces = n + 1;
  reflected.by_microfacets = eye->is_rough_there;
  reflected.spread += at->material.alpha;
  bool to_base, back;
  choose_branches(eye, &reflected, n, &to_base, &back);
  if (to_base && back) eye->pending[eye->waiting++] = reflected;
  if (!to_base) eye->lobes = LOBE_REFLECTION;
}

// Leaves to a branch what it has of a surface's light by wavelength, its mean in its share.
static inline void share_by_wavelength(EyeBranch* branch, Parts parts) {
  const float mean = 0.2f * (parts.four.x + parts.four.y + parts.four.z + parts.four.w + parts.middle),
              factor = mean > 0.0f ? 1.0f / mean : 0.0f;
  parts.four *= factor;
  parts.middle *= factor;
  leave_parts(&branch->path.throughput.own, parts);
  branch->share *= mean;
}

static inline bool visit_scatter(const World* world, Visitor* eye, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  EyeBranch *branch = &eye->branch, *reflected = &eye->before;
  branch->surfaces = reflected->surfaces = n + 1;
  reflected->by_microfacets = eye->is_rough_there;
  branch->by_microfacets = eye->is_rough_there && !sample->straight;
  branch->spread += at->material.alpha;
  reflected->spread = branch->spread;
  branch->scale *= sample->n_ratio * sample->n_ratio;
  Parts parts;
  const bool differ = reflected_parts(world, at, reflected->path.direction, &eye->band, sample, &parts);
  if (!sample->transmitted || (sample->reflectance == 0.0f && !differ)) return true;
  if (differ) {
    share_by_wavelength(reflected, parts);
    share_by_wavelength(branch, without_parts(parts));
  } else {
    reflected->share *= sample->reflectance;
    branch->share *= 1.0f - sample->reflectance;
  }
  bool goes_through, goes_back;
  choose_branches(eye, reflected, n, &goes_through, &goes_back);
  ScatterSample back;
  goes_back = goes_back &&
              scatter_path(world, &reflected->path, at, &eye->band, LOBE_REFLECTION, eye->numbers, &back);
  if (goes_through && goes_back)
    eye->pending[eye->waiting++] = *reflected;
  else if (goes_back)
    *branch = *reflected;
  return goes_through || goes_back;
}
