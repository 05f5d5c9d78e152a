// SPDX-License-Identifier: Apache-2.0
// The part of the layer "indirect" that begins as a caustic, or as the light of a narrow spot. Photons of one
// wavelength each leave the lights, towards glass and mirrors or all over the spot's cone. They are bent, and scattered
// by diffuse surfaces. From the second of these on, each adds to the pixel that sees it. Only absorption changes its
// power: reflectances decide by chance. A map takes photons for what glass and mirrors show.
#include "kernels/photons/pass_band.h"
#include "kernels/photons/photon_path.h"
#include "kernels/photons/splat.h"
#include "kernels/photons/store.h"
#include "kernels/tracing/work_item.h"

// 1: what the map's photons meet on their way to the eye has a wavelength: they share those of the pass with its paths.
#ifndef NEPHROID_SHARED_BANDS
#define NEPHROID_SHARED_BANDS 0
#endif

typedef struct {
  volatile __global long* film;
  float scale; // quanta per unit of radiance
  DeviceCamera camera;
  __global StoredPhoton* slot; // with NEPHROID_STORE: the photon's in the map
  float stored_scale;          // ... quanta per unit of power
  int object_count;
} Receiver;

typedef struct {
  Path path;
  SET_ASIDE float shading;  // product of shading_ratio over the diffuse surfaces behind it
  SET_ASIDE float watts;    // as if the band had all of the light's power
  SET_ASIDE int wavelength; // wavelength and weight of its band
  SET_ASIDE float weight;
  SET_ASIDE int number;     // of its band in the map (pass_band.h)
  SET_ASIDE int light;      // light and rgb of its source
  SET_ASIDE float3 rgb;
} Photon;

static inline Band band_of(const Photon* photon) {
  const Band band = {0, photon->wavelength, photon->weight};
  return band;
}

static inline Source light_of(const Photon* photon) {
  const Source source = {photon->light, photon->rgb};
  return source;
}

// Adds a photon's light, reflected by a diffuse surface, to the pixel that sees it. False where the film refused it.
static inline bool show(const World* world, const Receiver* receiver, const Photon* photon, const Surface* surface,
                        uint triangle, Reflector reflector, float dither, float2 lens) {
#if NEPHROID_LENS
  const DeviceCamera camera = through_lens(&receiver->camera, lens);
  const Splat splat = splat_at(world, &camera, surface, triangle, photon->path.direction);
#else
  const Splat splat = splat_at(world, &receiver->camera, surface, triangle, photon->path.direction);
#endif
  if (splat.pixel < 0) return true;
  const Band band = band_of(photon);
  const float3 xyz = carried_light(world, &photon->path.losses, light_of(photon), &band, reflector).xyz;
  const float scale = photon->watts * photon->shading * splat.weight / PI_F;
  return film_add_dithered(receiver->film, splat.pixel, xyz * scale, receiver->scale, FILM_LIMIT, dither);
}

#if NEPHROID_STORE
// Stores a photon, reflected by a diffuse surface. Of the surfaces that it meets one is drawn, this one with the chance
// 1 / met, and stands for all of them. False where the map refused it.
static inline bool store(const World* world, const Receiver* receiver, const Photon* photon, const Surface* surface,
                         Reflector reflector, uint met, float2 random) {
  if (random.x * (float)met >= 1.0f) return true;
  const Band band = band_of(photon);
  const float3 xyz = carried_light(world, &photon->path.losses, light_of(photon), &band, reflector).xyz;
  const float power = photon->watts * photon->shading * shading_ratio(surface, photon->path.direction);
  return store_photon(receiver->slot, surface, photon->path.direction, photon->number, receiver->object_count,
                      xyz * power, receiver->stored_scale, random.y);
}

// Makes the photon in a slot stand for `met` surfaces. False where it would carry too much.
static inline bool stand_for(__global StoredPhoton* slot, uint met) {
  if (met < 2u || slot->group == NO_PHOTON) return true;
  for (int c = 0; c < 3; ++c) {
    if ((float)slot->xyz[c] * (float)met > PHOTON_LIMIT) {
      slot->group = NO_PHOTON;
      return false;
    }
    slot->xyz[c] *= (int)met;
  }
  return true;
}
#endif

// Draws a photon's wavelength, by a number in [0, 1) and the light's chances of those of all clusters.
static inline void choose_wavelength(const World* world, __global const float* chances, float random, uint2 seed,
                                     uint pass, Photon* photon) {
  __global const int* const first = world->tables.cluster_first;
  const int members = first[world->scene.cluster_count];
  Band band = wavelength_of_cluster(0, world->tables.cluster_wavelengths, chances, members, random);
#if NEPHROID_STORE
  const int member = choose(chances, members, random);
  int cluster = 0, part = 0;
  while (first[cluster + 1] <= member) ++cluster;
#if NEPHROID_SHARED_BANDS
  const float before = chance_before(chances, first[cluster]), chance = chances[first[cluster + 1] - 1] - before;
  part = part_of_cluster((random - before) / chance);
  band = band_of_pass(world, cluster, part, seed, pass);
  band.weight /= chance;
#endif
  photon->number = band_number(cluster, part);
#endif
  photon->wavelength = band.wavelength;
  photon->weight = band.weight;
}

// Follows a photon to its end and returns its OUTCOME_*. *segments: rays of its path. Counts what the film refuses.
// narrow: of its light; the diffuse surfaces that others light are found from the eye (indirect.cl). *met: at how many
// surfaces it might be stored.
static inline int follow_photon(const World* world, const Receiver* receiver, Photon* photon, bool narrow,
                                uint2 seed, uint iteration, uint number, int* segments, uint* met, Outcomes outcomes) {
  Path* path = &photon->path;
  bool counts = narrow, met_diffuse = false;
#if NEPHROID_STORE
  bool met_glass = false; // before its first diffuse surface: paths from the eye do not find its light
#endif
  for (int surface_number = 0;; ++surface_number) {
    const Hit hit = next_hit(world, path);
    *segments = surface_number + 1;
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) return counts ? OUTCOME_ESCAPED : OUTCOME_MISSED;
    const Surface surface = surface_of(world, hit);
    const DeviceMaterial material = material_at(world, &surface, hit.primitive);
    lose_in_medium(world, path, hit.t);
    const float4 random = random4(seed, iteration, number, 2u + (uint)surface_number, STREAM_INDIRECT_PHOTONS);
    const Band band = band_of(photon);
    const float2 facet = facet_numbers(seed, iteration, number, (uint)surface_number, STREAM_INDIRECT_PHOTONS);
    const bool must_reflect = is_plastic(&material) && !counts; // as in trace_way
    float choice = random.x;
    if (is_plastic(&material) && counts)
      choice = random4(seed, iteration, number, 0x20000000u | (uint)surface_number, STREAM_INDIRECT_PHOTONS).x;
    const bool ends = ends_at(world, path->direction, &surface, &material, must_reflect ? -1.0f : choice, facet);
    if (ends) {
      if (!counts) return OUTCOME_MISSED;
#if NEPHROID_LENS
      const float2 lens = random4(seed, iteration, number, 128u + (uint)surface_number, STREAM_LENS).xy;
#else
      const float2 lens = (float2)(0.0f);
#endif
      const Reflector reflector = reflector_at(world, &surface, hit.primitive);
      if (met_diffuse && !show(world, receiver, photon, &surface, hit.primitive, reflector, random.w, lens))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
#if NEPHROID_STORE
      if (met_diffuse && met_glass &&
          !store(world, receiver, photon, &surface, reflector, ++*met,
                 random4(seed, iteration, number, 0x40000000u | (uint)surface_number, STREAM_INDIRECT_PHOTONS).xy))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
#endif
      met_diffuse = true;
      photon->shading *= shading_ratio(&surface, path->direction);
      const float side = dot(path->direction, surface.geometric) < 0.0f ? 1.0f : -1.0f;
      path->direction = cosine_direction(side * surface.geometric, random.y, random.z);
      const float part = reflectance_of(&world->tables, reflector, band.wavelength) *
                         part_through_coat(world, &surface, path->direction);
      if (random.x >= part) return OUTCOME_ABSORBED;
      photon->shading *= fmax(part, 1.0f); // of what a coat keeps from grazing ways, others have more
      path->origin = start_on_side(&surface, side);
      path->skip = hit.primitive;
      path->behind = 0.0f;
    }
    if (surface_number == world->scene.max_surfaces) return OUTCOME_LOST;
    counts = true;
    if (ends) continue;
#if NEPHROID_STORE
    met_glass = met_glass || !met_diffuse;
#endif
    float n_ratio;
    Bend bend;
    if (!bend_path_as(world, path, hit.primitive, &surface, &material, &band, random.x, facet, &n_ratio, &bend))
      return OUTCOME_LOST;
    if (must_reflect) lose_below_coat(path, &material, &bend);
  }
}

// Follows `count` photons offset, offset + stride, ... of a pass. emitters: one for each light that has photons.
__kernel void indirect_photons(WORLD_ARGUMENTS, __global const DeviceTarget* targets,
                               __global const DeviceEmitter* emitters, int emitter_count,
                               __global const float* spectrum_cdf, // [light][member of all clusters]: chances
                               volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                               __global StoredPhoton* stored, // [photon], with NEPHROID_STORE
                               int object_count, DeviceCamera camera, uint2 seed, uint iteration, uint offset,
                               uint stride, uint count, float film_scale, float energy_scale, float stored_scale) {
  const World world = WORLD;
  const int members = cluster_first[scene.cluster_count];
  Receiver receiver = {film_of_iteration(film, iteration, camera.width * camera.height), film_scale, camera,
                       stored, stored_scale, object_count};
  OUTCOMES(outcomes);
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint item = work_item() * NEPHROID_PHOTONS_PER_ITEM + k;
    if (item >= count) break;
    const uint number = offset + stride * item;
#if NEPHROID_STORE
    receiver.slot = stored + number;
    receiver.slot->group = NO_PHOTON;
#endif
    const DeviceEmitter emitter = emitters[emitter_of(emitters, emitter_count, number)];
    DeviceLight light = lights[emitter.light];
    const float4 random = random4(seed, iteration, number, 0u, STREAM_INDIRECT_PHOTONS);
    const float2 place =
        has_places(&light) ? random4(seed, iteration, number, 1u, STREAM_INDIRECT_PHOTONS).xy : (float2)(0.0f);
    const Source source = source_of(&world, emitter.light, place, &light);
    const bool narrow = is_narrow(&light);
    Emission emission =
        narrow ? emit_in_cone(&light, random) : emit(&light, targets, &scene, random, place);
    emission.watts *= photometric(&world, &light, emission.direction);
    if (emission.watts == 0.0f) continue;
    Photon photon = {
        {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE, light.inside, no_losses(), emission.behind},
        1.0f,
        emission.watts / (float)emitter.photon_count,
        0,
        0.0f,
        0,
        source.light,
        source.rgb};
    choose_wavelength(&world, spectrum_cdf + emitter.light * members, random.w, seed, iteration, &photon);
    int segments;
    uint met = 0u;
    const int outcome =
        follow_photon(&world, &receiver, &photon, narrow, seed, iteration, number, &segments, &met, outcomes);
#if NEPHROID_STORE
    if (!stand_for(receiver.slot, met)) add_outcome(outcomes, OUTCOME_REFUSED, 1);
#endif
    const Band end = band_of(&photon);
    count_photon(outcomes, outcome, segments,
                 photon.watts * band_share(&world, light_of(&photon), &end, 0.0f) * energy_scale,
                 wavelength_left(&world.tables, &photon.path.losses, photon.wavelength));
  }
  add_outcomes(energy, outcomes);
}
