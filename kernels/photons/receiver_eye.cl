// SPDX-License-Identifier: Apache-2.0
// What glass and mirrors show of the light on receivers: paths from the eye end on diffuse surfaces and take the mean
// of the light there over their footprints (receiver.h). At glass a path goes both ways, as long as that is much of
// what its pixel shows.
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/photons/receiver.h"
#include "kernels/tracing/work_item.h"
#include "kernels/transport/eye_path.h"
#include "kernels/transport/piece.h"
#include "kernels/transport/scatter_path.h"

// The part of a sample's light below which chance decides whether a branch is followed.
#define LEAST_SHARE 0.02f
// How many branches of a sample can wait to be followed.
#define EYE_PENDING 4

// A branch of a path, up to its last surface.
typedef struct {
  Path path;
  float share; // Fresnel's part of the pixel's radiance, over the chance that it is followed
  float scale; // beyond: of radiance, because what glass keeps is radiance over n^2
  int surfaces;
} EyeBranch;

// How a branch and those that wait are followed: the visitor of a walk.
typedef struct {
  Band band;
  EyeBranch branch, before; // now; at the surface that scatters it
  EyeBranch pending[EYE_PENDING];
  int waiting;
  uint2 seed;
  uint sample, pixel, scattered; // scattered: how many surfaces have scattered a branch
} Visitor;

static inline Band visitor_band(const Visitor* eye) { return eye->band; }

static inline WalkNumbers visitor_numbers(const Visitor* eye, const Interaction* at, int n) {
  const WalkNumbers none = {0.0f, (float2)(0.0f)}; // where light is kept, surfaces are polished
  return none;
}

static inline uint visitor_lobes(const Visitor* eye, const Interaction* at, int n) {
  return LOBE_DIFFUSE | LOBE_TRANSMISSION;
}

static inline void visit_surface(const World* world, Visitor* eye, const Path* path, const Interaction* at, int n) {
  if (!is_only_matt(&at->material)) eye->before = eye->branch;
}

static inline bool visit_scatter(const World* world, Visitor* eye, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n);

#define WALK_SURFACES
#define WALK_LOBES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// Decides by chance whether a branch of little light is followed, and then stands for those that are not.
static inline bool is_followed(EyeBranch* branch, float u) {
  if (branch->share >= LEAST_SHARE) return true;
  const float chance = branch->share / LEAST_SHARE;
  branch->share = LEAST_SHARE;
  return u < chance;
}

static inline bool visit_scatter(const World* world, Visitor* eye, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  EyeBranch *branch = &eye->branch, *reflected = &eye->before;
  branch->surfaces = reflected->surfaces = n + 1;
  branch->scale *= sample->n_ratio * sample->n_ratio;
  if (!sample->transmitted || sample->reflectance == 0.0f) return true;
  const float4 u = random4(eye->seed, eye->sample, eye->pixel, 1u + eye->scattered++, STREAM_VIEW);
  reflected->share *= sample->reflectance;
  branch->share *= 1.0f - sample->reflectance;
  bool goes_through = is_followed(branch, u.x), goes_back = is_followed(reflected, u.y);
  if (goes_through && goes_back && eye->waiting == EYE_PENDING) { // no room: one stands for both
    const float chance = branch->share / (branch->share + reflected->share);
    goes_through = u.z < chance;
    goes_back = !goes_through;
    branch->share /= chance;
    reflected->share /= 1.0f - chance;
  }
  const WalkNumbers none = {0.0f, (float2)(0.0f)};
  ScatterSample back;
  goes_back = goes_back && scatter_path(world, &reflected->path, at, &eye->band, LOBE_REFLECTION, none, &back);
  if (goes_through && goes_back)
    eye->pending[eye->waiting++] = *reflected;
  else if (goes_back)
    *branch = *reflected;
  return goes_through || goes_back;
}

// Begins the paths of a sample. place: in its pixel. False: what it meets first does not bend them.
static inline bool begin_sample(const World* world, Visitor* eye, DeviceCamera* camera, const Band* band, float2 place,
                                uint2 seed, uint sample, uint pixel, Hit* first) {
  float3 direction;
  *first = first_hit(world, camera, pixel, place, seed, sample, STREAM_VIEW, &direction);
  if (first->primitive == NEPHROID_NO_PRIMITIVE) return false;
  const DeviceMaterial met = material_of_hit(world, first);
  if (is_only_matt(&met)) return false;
  eye->band = *band;
  eye->branch.path = path_from_eye(camera, direction);
  eye->branch.share = eye->branch.scale = 1.0f;
  eye->branch.surfaces = 0;
  eye->waiting = 0;
  eye->seed = seed;
  eye->sample = sample;
  eye->pixel = pixel;
  eye->scattered = 0u;
  return true;
}

// A branch that has ended on a diffuse surface.
typedef struct {
  Surface surface;
  float side;   // of the surface, that it arrives on
  float3 a, b;  // its footprint, which is the sample's piece of its pixel
  float2 place; // in the piece
} EyeEnd;

// Follows a branch. place, edges: of the sample in its pixel and of its piece. False: it ends elsewhere.
IN_PLACE bool reaches_receiver(const World* world, Visitor* eye, Hit* first, float2 place, float2 edges, EyeEnd* end) {
  Interaction at;
  int surface_number;
  Path* const path = &eye->branch.path;
  const int surfaces = eye->branch.surfaces;
  if (walk(world, eye, path, first, surfaces == 0, surfaces, &at, &surface_number) != WALK_AT_BASE) return false;
  const float3 normal = at.surface.geometric;
  const float distance = dot(at.surface.position - path->origin, path->direction);
  end->surface = at.surface;
  end->side = dot(path->direction, normal) < 0.0f ? 1.0f : -1.0f;
  end->a = edges.x * transferred(&path->by_place[0], path->direction, distance, normal);
  end->b = edges.y * transferred(&path->by_place[1], path->direction, distance, normal);
  end->place = place / edges - floor(place / edges);
  return true;
}

// The pages that the first ends of each pixel's first sample ask for. looks: [count][ASKING_ENDS].
__kernel void ask_for_pages(WORLD_ARGUMENTS, __global const int* receiver_table, DeviceCamera camera,
                            __global const uint* pixels, DeviceLookLaunch launch, __global DeviceLook* looks) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= launch.count) return;
  const Receivers on = receivers_of(receiver_table);
  const uint pixel = pixels[launch.first + index];
  const DeviceLook none = {NO_PAGE, 0.0f, 0.0f, 0};
  for (uint i = 0; i < ASKING_ENDS; ++i) looks[ASKING_ENDS * index + i] = none;
  const float2 place = eye_numbers(launch.seed, launch.first_sample, 1u, pixel, 0u, STREAM_VIEW).xy;
  float chance;
  const Band band = choose_eye_band(&world, scene.light_count, 0.5f, &chance);
  DeviceCamera from = camera;
  Visitor eye;
  Hit hit;
  if (!begin_sample(&world, &eye, &from, &band, place, launch.seed, launch.first_sample, pixel, &hit)) return;
  for (uint i = 0; i < ASKING_ENDS; ++i) {
    EyeEnd end;
    if (reaches_receiver(&world, &eye, &hit, place, (float2)(1.0f), &end)) {
      const ChartLook look = look_on_chart(&on, &end.surface, end.side, end.a, end.b, end.place);
      const DeviceLook asked = {look.chart, look.middle.x, look.middle.y, look.level};
      if (look.chart != NO_PAGE) looks[ASKING_ENDS * index + i] = asked;
    }
    if (eye.waiting == 0) break;
    eye.branch = eye.pending[--eye.waiting];
  }
}

// The light of an end. Where nothing has parted or coloured its wavelengths, that of all layers; else that of its
// cluster's layer, over the chance of that.
static inline float3 light_of_end(const World* world, const Receivers* on, __global const float* totals, uint film_half,
                                  const EyeEnd* end, const Throughput* throughput, const Band* band) {
  if (!throughput->is_split && is_full(throughput))
    return look_at_receiver(on, &end->surface, end->side, end->a, end->b, end->place,
                            totals + first_texel(on, film_half, 0), on->layers);
  const int clusters = world->scene.cluster_count, layer = layer_of(on, band->cluster, clusters),
            first = (layer * clusters + on->layers - 1) / on->layers,
            next = ((layer + 1) * clusters + on->layers - 1) / on->layers;
  const float chance = world->cluster_cdf[next] - world->cluster_cdf[first];
  return part_left(throughput) / chance *
         look_at_receiver(on, &end->surface, end->side, end->a, end->b, end->place,
                          totals + first_texel(on, film_half, layer), 1);
}

// totals: by receiver_light.cl.
__kernel void see_receivers(WORLD_ARGUMENTS, __global const int* receiver_table, __global const float* totals,
                            volatile __global long* film,
                            volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                            DeviceCamera camera, __global const uint* pixels, DeviceLookLaunch launch) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= launch.count) return;
  const Receivers on = receivers_of(receiver_table);
  const uint pixel = pixels[launch.first + index];
  float3 xyz = (float3)(0.0f);
  float dither = 0.5f;
  for (uint k = 0; k < launch.sample_count; ++k) {
    const uint sample = launch.first_sample + launch.sample_step * k;
    const float4 jitter = eye_numbers(launch.seed, sample, 1u, pixel, 0u, STREAM_VIEW);
    dither = jitter.z;
    float chance;
    const Band band = choose_eye_band(&world, scene.light_count,
                                      golden_place(launch.seed, sample, 0u, 1u, pixel, STREAM_VIEW_CLUSTER), &chance);
    // Light is not even over a piece as a sky is: pieces shrink twice as fast, in proportion to the sample's number to
    // the power of -4/3, so that what a bent piece does to the mean vanishes.
    const uint number = min(sample / launch.sample_step, 0xffffu);
    const float2 edges = piece_edges(number * number);
    DeviceCamera from = camera;
    Visitor eye;
    Hit hit;
    if (!begin_sample(&world, &eye, &from, &band, jitter.xy, launch.seed, sample, pixel, &hit)) continue;
    for (;;) {
      EyeEnd end;
      if (reaches_receiver(&world, &eye, &hit, jitter.xy, edges, &end))
        xyz += eye.branch.share * eye.branch.scale *
               light_of_end(&world, &on, totals, launch.film_half, &end, &eye.branch.path.throughput, &band);
      if (eye.waiting == 0) break;
      eye.branch = eye.pending[--eye.waiting];
    }
  }
  add_sample(film, energy, &camera, pixel, launch.film_half, xyz / (float)launch.sample_count, launch.film_per_quantum,
             FILM_LIMIT, dither);
}
