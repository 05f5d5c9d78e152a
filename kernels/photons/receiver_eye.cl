// SPDX-License-Identifier: Apache-2.0
// What glass and mirrors show of the light on receivers: paths from the eye end on diffuse surfaces and take the mean
// of the light there over their footprints (receiver.h). At glass a path goes both ways, as long as that is much of
// what its pixel shows.
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/lights/transmittance.h"
#include "kernels/photons/receiver.h"
#include "kernels/tracing/work_item.h"
#include "kernels/transport/branches.h"
#include "kernels/transport/eye_band.h"
#include "kernels/transport/piece.h"
#include "kernels/transport/sweep.h"

// Begins the paths of a sample. place: in its pixel. False: what it meets first does not bend them.
static inline bool begin_sample(const World* world, Visitor* eye, DeviceCamera* camera, const Band* band, float2 place,
                                uint2 seed, uint sample, uint pixel, Hit* first) {
  float3 direction;
  *first = first_hit(world, camera, pixel, place, seed, sample, STREAM_VIEW, &direction);
  if (first->primitive == NEPHROID_NO_PRIMITIVE) return false;
  const DeviceMaterial met = material_of_hit(world, first);
  if (is_only_matt(&met)) return false;
  const Path path = path_from_eye(camera, direction);
  begin_branches(eye, &path, band, seed, sample, 0u, 1u, pixel, STREAM_VIEW);
  return true;
}

// A branch that has ended on a diffuse surface.
typedef struct {
  Surface surface;
  uint triangle;
  float side;   // of the surface, that it arrives on
  float3 a, b;  // its footprint, which is the sample's piece of its pixel
  float2 place; // in the piece
} EyeEnd;

// Follows a branch. place, edges: of the sample in its pixel and of its piece. False: it ends elsewhere.
IN_PLACE bool reaches_receiver(const World* world, Visitor* eye, Hit* first, float2 place, float2 edges, EyeEnd* end) {
  Interaction at;
  int surface_number;
  Path* const path = &eye->branch.path;
  if (follow_branch(world, eye, first, &at, &surface_number) != WALK_AT_BASE) return false;
  const float3 normal = at.surface.geometric;
  const float distance = dot(at.surface.position - path->origin, path->direction);
  end->surface = at.surface;
  end->triangle = at.triangle;
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
  const Band band = choose_eye_band(&world, 0.5f, 1u, &chance);
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
    if (!next_branch(&eye)) break;
  }
}

// The chances of a layer's clusters, from the first place on and before the last (member_at).
static inline float2 places_of_layer(const World* world, const Receivers* on, int layer) {
  const int clusters = world->scene.cluster_count;
  return (float2)(world->cluster_cdf[(layer * clusters + on->layers - 1) / on->layers],
                  world->cluster_cdf[((layer + 1) * clusters + on->layers - 1) / on->layers]);
}

// One layer's light on a surface that the branch arrives at. first: of all totals of the half.
static inline float3 look_at_layer(const Receivers* on, const Path* path, const EyeEnd* end, const Surface* surface,
                                   __global const float* first, int layer) {
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  return look_at_receiver(on, surface, side, end->a, end->b, end->place, first + 3 * PAGE_TEXELS * (size_t)layer, 1);
}

// What a path leaves of the light at its end, over the chance of its band. Where glass has split its wavelengths, the
// light of each quarter of its part of the spectrum, and in it of each layer, is found at a place of its own.
static inline float3 light_of_end(const World* world, const Receivers* on, __global const float* totals, uint film_half,
                                  const EyeEnd* end, const Path* path, const Band* band) {
  const Throughput* throughput = &path->throughput;
  const bool is_whole = !throughput->is_split && is_full(throughput);
  const int clusters = world->scene.cluster_count;
  __global const float* const first = totals + first_texel(on, film_half, 0);
  if (is_whole || on->layers == 1) {
    const float3 light =
        look_at_receiver(on, &end->surface, end->side, end->a, end->b, end->place, first, on->layers);
    if (is_whole) return light;
    const Reflector reflector = reflector_of_row(material_of(world, end->surface.object).reflector);
    return transmittance(world, throughput, band, reflector) * light;
  }
  if (!NEPHROID_JITTER) { // no glass disperses
    const int layer = layer_of(on, band->cluster, clusters);
    const float2 places = places_of_layer(world, on, layer);
    return part_left(throughput) / (places.y - places.x) * look_at_layer(on, path, end, &end->surface, first, layer);
  }
  const bool unsplit = is_unsplit(throughput, band), swept = is_swept(world, path, band);
  const Parts* parts = unsplit ? &throughput->all : &throughput->own;
  Band shown = *band;
  if (unsplit) {
    shown.within = band->low + band->size * band->within;
    shown.low = 0.0f;
    shown.size = 1.0f;
  }
  float3 xyz = (float3)(0.0f);
  for (int i = 0; i < 4; ++i) {
    const Band quarter = quarter_of_band(&shown, i);
    const float last_place = quarter.low + quarter.size;
    Surface surface = end->surface;
    uint triangle = end->triangle;
    if (swept)
      move_end(world, path, beyond_leader(world, band, number_of_four_wavelengths(&band->own, i)), &surface, &triangle);
    const int last_layer = layer_of(on, member_at(world, last_place).cluster, clusters);
    for (int layer = layer_of(on, member_at(world, quarter.low).cluster, clusters); layer <= last_layer; ++layer) {
      const float2 places = places_of_layer(world, on, layer),
                   here = (float2)(fmax(places.x, quarter.low), fmin(places.y, last_place));
      if (!(here.y > here.x)) continue;
      Surface of_layer = surface;
      if (swept) {
        const int wavelength = wavelength_at(world, here.x + band->within * (here.y - here.x), 1.0f).wavelength;
        float3 place;
        if (stretched_place(path, &surface, beyond_leader(world, band, wavelength), &place)) of_layer.position = place;
      }
      xyz += parts->middle * (here.y - here.x) / (places.y - places.x) / shown.size *
             look_at_layer(on, path, end, &of_layer, first, layer);
    }
    if (!are_coloured(parts)) continue;
    const Member carrier = member_at(world, shown.low + shown.size * quarters_on(shown.within, i));
    const int layer = layer_of(on, carrier.cluster, clusters);
    const float2 places = places_of_layer(world, on, layer);
    xyz += 0.25f * (number_of_four(parts->four, i) - parts->middle) / (places.y - places.x) *
           look_at_layer(on, path, end, &surface, first, layer);
  }
  return xyz;
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
    const Band band =
        band_of_eye_path(&world, launch.seed, sample, 0u, 1u, pixel, STREAM_VIEW_CLUSTER, &chance);
    // Light is not even over a piece as a sky is: pieces shrink twice as fast, in proportion to the sample's number to
    // the power of -4/3, so that what a bent piece does to the mean vanishes.
    const uint number = min(sample / launch.sample_step, 0xffffu);
    const float2 edges = piece_edges(number * number);
    DeviceCamera from = camera;
    Visitor eye;
    Hit hit;
    if (!begin_sample(&world, &eye, &from, &band, jitter.xy, launch.seed, sample, pixel, &hit)) continue;
    do {
      EyeEnd end;
      if (reaches_receiver(&world, &eye, &hit, jitter.xy, edges, &end))
        xyz += eye.branch.share * eye.branch.scale *
               light_of_end(&world, &on, totals, launch.film_half, &end, &eye.branch.path, &band);
    } while (next_branch(&eye));
  }
  add_sample(film, energy, &camera, pixel, launch.film_half, xyz / (float)launch.sample_count, launch.film_per_quantum,
             FILM_LIMIT, dither);
}
