// SPDX-License-Identifier: Apache-2.0
// The part of the layer "indirect" that begins as a caustic, or as the light of a narrow spot. Photons of one
// wavelength each leave the lights, towards glass and mirrors or all over the spot's cone. They are bent, and scattered
// by diffuse surfaces. From the second of these on, each adds to the pixel that sees it. Only absorption changes its
// power: reflectances decide by chance.
#include "kernels/photons/photon_path.h"
#include "kernels/photons/splat.h"
#include "kernels/tracing/work_item.h"

typedef struct {
  volatile __global long* film;
  float scale; // quanta per unit of radiance
  DeviceCamera camera;
} Receiver;

typedef struct {
  Path path;
  SET_ASIDE float shading;  // product of shading_ratio over the diffuse surfaces behind it
  SET_ASIDE float watts;    // as if the band had all of the light's power
  SET_ASIDE int wavelength; // wavelength and weight of its band
  SET_ASIDE float weight;
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

// Follows a photon to its end and returns its OUTCOME_*. *segments: rays of its path. Counts what the film refuses.
// narrow: of its light; the diffuse surfaces that others light are found from the eye (indirect.cl).
static inline int follow_photon(const World* world, const Receiver* receiver, Photon* photon, bool narrow,
                                uint2 seed, uint iteration, uint number, int* segments, Outcomes outcomes) {
  Path* path = &photon->path;
  bool counts = narrow, met_diffuse = false;
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
                               DeviceCamera camera, uint2 seed, uint iteration, uint offset, uint stride, uint count,
                               float film_scale, float energy_scale) {
  const World world = WORLD;
  const int members = cluster_first[scene.cluster_count];
  const Receiver receiver = {film_of_iteration(film, iteration, camera.width * camera.height), film_scale, camera};
  OUTCOMES(outcomes);
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint item = work_item() * NEPHROID_PHOTONS_PER_ITEM + k;
    if (item >= count) break;
    const uint number = offset + stride * item;
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
    const Band band =
        wavelength_of_cluster(0, cluster_wavelengths, spectrum_cdf + emitter.light * members, members, random.w);
    Photon photon = {
        {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE, light.inside, no_losses(), emission.behind},
        1.0f,
        emission.watts / (float)emitter.photon_count,
        band.wavelength,
        band.weight,
        source.light,
        source.rgb};
    int segments;
    const int outcome = follow_photon(&world, &receiver, &photon, narrow, seed, iteration, number, &segments, outcomes);
    const Band end = band_of(&photon);
    count_photon(outcomes, outcome, segments,
                 photon.watts * band_share(&world, light_of(&photon), &end, 0.0f) * energy_scale,
                 wavelength_left(&world.tables, &photon.path.losses, photon.wavelength));
  }
  add_outcomes(energy, outcomes);
}
