// SPDX-License-Identifier: Apache-2.0
// The caustic layer: photons of each wavelength cluster leave the lights towards the caustic objects, are bent by glass
// and mirrors, and are splatted into the pixel that sees the diffuse surface they reach.
#include "kernels/photons/guide.h"
#include "kernels/photons/launch_types.h"
#include "kernels/photons/pass_band.h"
#include "kernels/photons/photon_path.h"
#include "kernels/photons/receiver.h"
#include "kernels/photons/store.h"
#include "kernels/photons/stretch.h"

// 1: photons are guided to where they matter, and that is measured.
#ifndef NEPHROID_MOMENTS
#define NEPHROID_MOMENTS 0
#endif

// 0: no splats.
#ifndef NEPHROID_SPLAT
#define NEPHROID_SPLAT 1
#endif

#if NEPHROID_RECEIVERS
// A photon's light in its layer, as the xyz of its end. That is of all clusters until glass splits it; in a layer it is
// that of its own, where one layer has all of it, or of its own wavelength.
static inline float3 light_of_layer(const World* world, const Receivers* on, Source source, const PhotonEnd* end,
                                    const Path* path, const Band* band) {
  if (!is_unsplit(&path->throughput, band) || on->layers == 1) return end->xyz;
  Throughput alone = path->throughput;
  alone.is_split = true;
  Band whole = *band;
  if (is_of_one_layer(on, &world->tables, band->cluster)) whole.wavelength = -1;
  return carried_light(world, &alone, source, &whole, reflector_at(world, &end->surface, end->triangle)).xyz;
}
#endif

// energy counts what photons carry, whatever a smooth receiver's shading normals make of it.
PHOTON_KERNEL(photons, (WORLD_ARGUMENTS, __global const DeviceEmitter* emitters,
                        volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                        volatile __global long* moments,                            // with NEPHROID_MOMENTS: [emitter]
                        volatile __global long* guide_moments,                      // ... [light][GUIDE_CELLS]
                        __global const float* guide,                                // ... [light][GUIDE_FLOATS]
                        __global const float* worth,                                // ... and NEPHROID_METER: [cell]
                        __global StoredPhoton* stored,                              // with NEPHROID_STORE: [photon]
                        __global const int* receiver_table, volatile __global long* light, // with NEPHROID_RECEIVERS
                        DeviceCamera camera, DevicePhotonLaunch launch),
                       (WORLD_NAMES, emitters, film, energy, moments, guide_moments, guide, worth, stored,
                        receiver_table, light, camera, launch)) {
  const World world = WORLD;
#if NEPHROID_RECEIVERS
  const Receivers receivers = receivers_of(receiver_table);
#endif
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = index * NEPHROID_PHOTONS_PER_ITEM + k;
    if (number >= launch.count) break;
    const uint place = launch.offset + launch.stride * neighbours_follow(number, launch.count);
    const uint batch = launch.iteration + place / launch.photons_per_batch,
               photon = place % launch.photons_per_batch;
#if NEPHROID_STORE
    stored[place].group = NO_PHOTON;
#endif
    PhotonStart start = photon_start(emitters, launch.emitter_count, world.lights, launch.seed, batch,
                                     launch.first_iteration, photon);
    const DeviceEmitter emitter = emitters[start.emitter];
#if NEPHROID_MOMENTS
    const Guided guided = guide_numbers(guide + emitter.light * GUIDE_FLOATS, &start.emission);
    long moment = 0;
#else
    const Guided guided = {1.0f, 0u};
#endif
    const Emission emission = emit(&world, emitter.light, start.emission, start.place);
    const Source source = emission.source;
    if (emission.watts == 0.0f) continue;
    Band band = choose_band(&world, emitter.light, emitter.cluster, start.wavelength);
#if NEPHROID_STORE && NEPHROID_JITTER
    lead(&band, band_of_pass(&world, emitter.cluster, launch.seed, launch.map_pass));
#endif
#if NEPHROID_SPLAT && NEPHROID_JITTER && NEPHROID_UNSPLIT
    carry_all_of_light(&world, emitters, launch.emitter_count, &start, &band);
#endif
    SET_ASIDE float share = band_share(&world, source, &band, emitter.share), dither = start.emission.w,
                    wavelength = start.wavelength;
    SET_ASIDE float watts =
        emission.watts / ((float)emitter.photon_count * guided.density); // as if the band had all of the light's power
    Path path = {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE,
                 world.lights[emitter.light].inside,    full_throughput(),  emission.behind};
#if NEPHROID_METER
    Visitor visitor = photon_visitor(&band, launch.seed, batch, photon);
    visitor.source = source;
    visitor.watts = watts;
    visitor.film = meter_film(&camera, film_of_iteration(film, batch, camera.width * camera.height), launch.film_scale,
                              dither, NEPHROID_MOMENTS ? worth : 0);
    PhotonEnd end = follow_photon(&world, &visitor, &path);
    end.share = share_at_end(&world, &path.throughput, source, &band, share);
    end.left = power_left(&world, &path.throughput, source, &band, end.share);
    if (visitor.film.refused != 0) add_outcome(outcomes, OUTCOME_REFUSED, visitor.film.refused);
#if NEPHROID_MOMENTS
    moment = visitor.film.moment;
#endif
#else
    const PhotonEnd end = trace_photon(&world, source, &band, share, &path, launch.seed, batch, photon);
#endif
#if NEPHROID_STORE
    if (end.outcome == OUTCOME_DEPOSITED) {
      const float3 xyz = end.xyz * (watts * shading_ratio(&end.surface, path.direction));
      if (!store_photon(stored + place, &end.surface, path.direction, emitter.cluster, launch.object_count, xyz,
                        launch.stored_scale, dither))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
    }
#endif
#if NEPHROID_RECEIVERS
    if (end.outcome == OUTCOME_DEPOSITED) {
      const float side = dot(path.direction, end.surface.geometric) < 0.0f ? 1.0f : -1.0f;
      const float3 xyz = light_of_layer(&world, &receivers, source, &end, &path, &band);
      const float power = watts * shading_ratio(&end.surface, path.direction) * launch.stored_scale;
      const int layer = layer_of_band(&receivers, &world.tables, &band);
      if (!add_to_receiver(&receivers, &end.surface, side, (float3)(0.0f), (float3)(0.0f),
                           light + first_texel(&receivers, batch % NEPHROID_FILM_HALVES, 0, layer), xyz * power))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
    }
#endif
    if (NEPHROID_SPLAT > NEPHROID_METER && end.outcome == OUTCOME_DEPOSITED) { // a meter has what crossed it
      const Stretch stretch = stretch_of(&world, &camera, &end, &path, &band);
#if NEPHROID_LENS
      const DeviceCamera seen_from = through_lens(&camera, random4(launch.seed, batch, photon, 0u, STREAM_LENS).xy);
#else
#define seen_from camera
#endif
      volatile __global long* const sums = film_of_iteration(film, batch, camera.width * camera.height);
      for (int i = 0; i < stretch.count; ++i) {
        Strand strand;
        if (!strand_of(&world, &end, &path, source, &band, &stretch, i, wavelength, &strand)) continue;
        const Splat splat = splat_at(&world, &seen_from, &strand.surface, strand.triangle, path.direction);
        if (splat.pixel < 0) continue;
        const float3 xyz = strand.xyz * (watts * splat.weight / PI_F);
        const float turn = dither + 0.61803399f * (float)i; // each strand has its own
        if (!film_add_dithered(sums, splat.pixel, xyz, launch.film_scale, FILM_LIMIT, turn - floor(turn)))
          add_outcome(outcomes, OUTCOME_REFUSED, 1);
#if NEPHROID_MOMENTS
        moment += squared(xyz, launch.film_scale);
#endif
      }
    }

#if NEPHROID_MOMENTS
    if (NEPHROID_RECEIVERS && end.outcome == OUTCOME_DEPOSITED && moment == 0)
      moment = squared(end.xyz * (watts * launch.unseen_weight / PI_F), launch.film_scale);
    if (moment != 0) {
      add_exactly(moments + start.emitter, moment);
      add_exactly(guide_moments + emitter.light * GUIDE_CELLS + guided.cell, moment);
    }
#endif
    count_photon(outcomes, end.outcome, end.segments, watts * end.share * launch.energy_scale, end.left);
  }
}
