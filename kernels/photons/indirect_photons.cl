// SPDX-License-Identifier: Apache-2.0
// The part of the layer "indirect" that begins as a caustic, or as the light of a narrow spot. Photons of one
// wavelength each leave the lights, towards glass and mirrors or all over the spot's cone. They are bent, and scattered
// by diffuse surfaces. From the second of these on, each adds to the pixel that sees it. Only absorption changes its
// power: reflectances decide by chance. Receivers keep their light for what glass and mirrors show.
#include "kernels/photons/launch_types.h"
#include "kernels/photons/photon_start.h"
#include "kernels/photons/splat.h"
#include "kernels/tracing/meter.h"
#include "kernels/photons/receiver.h"
#include "kernels/transport/scatter_path.h"

typedef struct {
  volatile __global long* film;
  float scale; // quanta per unit of radiance
  DeviceCamera camera;
#if NEPHROID_RECEIVERS
  Receivers receivers;
  volatile __global long* light; // sums of the half's second kind
  float stored_scale;            // quanta per unit of power
#endif
} Receiver;

typedef struct {
  const Receiver* receiver;
  SET_ASIDE float shading;  // product of shading_ratio over the diffuse surfaces behind it
  SET_ASIDE float watts;    // as if the band had all of the light's power
  SET_ASIDE int wavelength; // wavelength and weight of its band
  SET_ASIDE float weight;
  SET_ASIDE int light; // light and rgb of its source
  SET_ASIDE float3 rgb;
  uint2 seed;
  uint iteration, number;
  bool counts;      // it has met glass or a mirror, or comes from a narrow spot: others light is found from the eye
  bool met_diffuse;
  bool met_glass; // before its first diffuse surface: paths from the eye do not find its light
  bool is_absorbed;
  int refused; // contributions, by the film
#if NEPHROID_METER
  MeterFilm on_meter;
#endif
} Visitor;

static inline Band visitor_band(const Visitor* photon) {
  return one_wavelength(0, photon->wavelength, photon->weight);
}

static inline Source light_of(const Visitor* photon) {
  const Source source = {photon->light, photon->rgb};
  return source;
}

static inline float4 photon_numbers(const Visitor* photon, uint block) {
  return random4(photon->seed, photon->iteration, photon->number, block, STREAM_INDIRECT_PHOTONS);
}

static inline WalkNumbers visitor_numbers(const Visitor* photon, const Interaction* at, int n) {
  const bool chooses_base = has_coat(&at->material) && photon->counts;
  const WalkNumbers numbers = {
      photon_numbers(photon, chooses_base ? 0x20000000u | (uint)n : 2u + (uint)n).x,
      microfacet_numbers(photon->seed, photon->iteration, photon->number, (uint)n, STREAM_INDIRECT_PHOTONS)};
  return numbers;
}

// As photon_path.h: what comes straight from the light to a coat is reflected.
static inline uint visitor_lobes(const Visitor* photon, const Interaction* at, int n) {
  return photon->counts || is_only_matt(&at->material) ? LOBES_ALL : LOBES_ALL & ~LOBE_DIFFUSE;
}

// Adds a photon's light, reflected by a diffuse surface, to the pixel that sees it.
static inline void show(const World* world, Visitor* photon, const Path* path, const Interaction* at,
                        Reflector reflector, float dither, int n) {
  const Receiver* receiver = photon->receiver;
#if NEPHROID_LENS
  const float2 lens = random4(photon->seed, photon->iteration, photon->number, 128u + (uint)n, STREAM_LENS).xy;
  const DeviceCamera camera = through_lens(&receiver->camera, lens);
  const Splat splat = splat_at(world, &camera, &at->surface, at->triangle, path->direction);
#else
  const Splat splat = splat_at(world, &receiver->camera, &at->surface, at->triangle, path->direction);
#endif
  if (splat.pixel < 0) return;
  const Band band = visitor_band(photon);
  const float3 xyz = carried_light(world, &path->throughput, light_of(photon), &band, reflector).xyz;
  const float scale = photon->watts * photon->shading * splat.weight / PI_F;
  if (!film_add_dithered(receiver->film, splat.pixel, xyz * scale, receiver->scale, FILM_LIMIT, dither))
    ++photon->refused;
}

#if NEPHROID_METER
static inline void measure(const World* world, Visitor* photon, const Path* path, int cell) {
  if (cell < 0 || !photon->met_diffuse || !photon->counts) return;
  const Band band = visitor_band(photon);
  const float3 xyz = carried_light(world, &path->throughput, light_of(photon), &band, white_reflector()).xyz;
  add_to_cell(world, &photon->on_meter, cell, xyz * (photon->watts * photon->shading));
}

static inline void visit_segment(const World* world, Visitor* photon, const Path* path, const Hit* hit) {
  measure(world, photon, path, cell_crossed(world, photon->on_meter.meter, path, hit->t));
}

static inline void visit_surface(const World* world, Visitor* photon, const Path* path, const Interaction* at, int n) {
  measure(world, photon, path, cell_met(world, photon->on_meter.meter, &at->surface, path->direction));
}

#define WALK_SEGMENTS
#define WALK_SURFACES
#endif

#if NEPHROID_RECEIVERS
// Leaves a photon's light, reflected by a diffuse surface, on its receiver.
static inline void leave(const World* world, Visitor* photon, const Path* path, const Interaction* at,
                         Reflector reflector) {
  const Receiver* to = photon->receiver;
  const Band band = visitor_band(photon);
  const float3 xyz = carried_light(world, &path->throughput, light_of(photon), &band, reflector).xyz;
  const float power = photon->watts * photon->shading * shading_ratio(&at->surface, path->direction);
  const float side = dot(path->direction, at->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  const int layer = layer_of(&to->receivers, photon->wavelength);
  if (!add_to_receiver(&to->receivers, &at->surface, side, (float3)(0.0f), (float3)(0.0f),
                       to->light + 3 * PAGE_TEXELS * (size_t)layer, xyz * (power * to->stored_scale)))
    ++photon->refused;
}
#endif

static inline bool visit_base(const World* world, Visitor* photon, Path* path, const Interaction* at, int n) {
  if (!photon->counts) return false;
  const float4 random = photon_numbers(photon, 2u + (uint)n);
  const Reflector reflector = reflector_at(world, &at->surface, at->triangle);
  if (!NEPHROID_METER && photon->met_diffuse) show(world, photon, path, at, reflector, random.w, n);
#if NEPHROID_RECEIVERS
  if (photon->met_diffuse && photon->met_glass) leave(world, photon, path, at, reflector);
#endif
  photon->met_diffuse = true;
  photon->shading *= shading_ratio(&at->surface, path->direction);
  const float side = dot(path->direction, at->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  path->direction = cosine_direction(side * at->surface.geometric, random.y, random.z);
  const float part = reflectance_of(&world->tables, reflector, photon->wavelength) *
                     part_to_base(world, &at->surface, path->direction);
  photon->is_absorbed = random.x >= part;
  if (photon->is_absorbed) return false;
  photon->shading *= fmax(part, 1.0f); // of what a coat keeps from grazing ways, others have more
  path->origin = start_on_side(&at->surface, side);
  path->skip = at->triangle;
  path->behind = 0.0f;
  return true;
}

static inline bool visit_scatter(const World* world, Visitor* photon, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  if (!photon->counts && has_coat(&at->material)) lose_to_base(path, sample);
  photon->counts = true;
  photon->met_glass = photon->met_glass || !photon->met_diffuse;
  return true;
}

#define WALK_LOBES
#define WALK_BASES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

// emitters: one for each light that has photons.
PHOTON_KERNEL(indirect_photons, (WORLD_ARGUMENTS,
                                 __global const DeviceEmitter* emitters,
                                 __global const float* spectrum_cdf, // [light][member of all clusters]: chances
                                 volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                                 __global const int* receiver_table, // with NEPHROID_RECEIVERS
                                 volatile __global long* light,      // likewise
                                 DeviceCamera camera, DevicePhotonLaunch launch),
                                (WORLD_NAMES, emitters, spectrum_cdf, film, energy, receiver_table, light, camera,
                                 launch)) {
  const World world = WORLD;
  const int members = world.tables.cluster_first[scene.cluster_count];
  Receiver receiver;
  receiver.film = film_of_iteration(film, launch.iteration, camera.width * camera.height);
  receiver.scale = launch.film_scale;
  receiver.camera = camera;
#if NEPHROID_RECEIVERS
  receiver.receivers = receivers_of(receiver_table);
  receiver.light = light + first_texel(&receiver.receivers, launch.iteration % NEPHROID_FILM_HALVES, 1, 0);
  receiver.stored_scale = launch.stored_scale;
#endif
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint item = index * NEPHROID_PHOTONS_PER_ITEM + k;
    if (item >= launch.count) break;
    const uint number = launch.offset + launch.stride * item;
    const DeviceEmitter emitter = emitters[emitter_of(emitters, launch.emitter_count, number)];
    __global const DeviceLight* light = world.lights + emitter.light;
    const float4 random = random4(launch.seed, launch.iteration, number, 0u, STREAM_INDIRECT_PHOTONS);
    const float2 place = has_places(light)
                             ? random4(launch.seed, launch.iteration, number, 1u, STREAM_INDIRECT_PHOTONS).xy
                             : (float2)(0.0f);
    const bool narrow = is_narrow(light);
    const Emission emission =
        narrow ? emit_in_cone(light, emitter.light, random) : emit(&world, emitter.light, random, place);
    if (emission.watts == 0.0f) continue;
    Visitor photon;
    photon.receiver = &receiver;
    photon.shading = 1.0f;
    photon.watts = emission.watts / (float)emitter.photon_count;
    photon.light = emission.source.light;
    photon.rgb = emission.source.rgb;
    photon.seed = launch.seed;
    photon.iteration = launch.iteration;
    photon.number = number;
    photon.counts = narrow;
    photon.met_diffuse = photon.met_glass = photon.is_absorbed = false;
    photon.refused = 0;
#if NEPHROID_METER
    photon.on_meter = meter_film(&camera, receiver.film, launch.film_scale, random.w, 0);
#endif
    const DrawnWavelength drawn = wavelength_of_cluster(
        world.tables.cluster_wavelengths, spectrum_cdf + emitter.light * members, members, random.w);
    photon.wavelength = drawn.wavelength;
    photon.weight = drawn.weight;
    Path path = {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE,
                 light->inside,    full_throughput(),  emission.behind};
    Hit hit;
    Interaction at;
    int last;
    const int how = walk(&world, &photon, &path, &hit, false, 0, &at, &last);
    const int outcome = photon.is_absorbed     ? OUTCOME_ABSORBED
                        : how == WALK_LOST     ? OUTCOME_LOST
                        : how == WALK_LEFT && photon.counts ? OUTCOME_ESCAPED
                                               : OUTCOME_MISSED;
#if NEPHROID_METER
    photon.refused += photon.on_meter.refused;
#endif
    add_outcome(outcomes, OUTCOME_REFUSED, photon.refused);
    const Band band = visitor_band(&photon);
    count_photon(outcomes, outcome, last + 1,
                 photon.watts * band_share(&world, emission.source, &band, 0.0f) * launch.energy_scale,
                 part_left(&path.throughput));
  }
}
