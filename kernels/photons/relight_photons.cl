// SPDX-License-Identifier: Apache-2.0
// The caustic layer for relighting: photons.cl, whose splats go into the layer of their lamp and cluster (layers.h).
#include "kernels/photons/launch_types.h"
#include "kernels/photons/layers.h"
#include "kernels/photons/photon_path.h"
#include "kernels/photons/splat.h"

// All lamps have 1 W or 1 W m^-2. An emitter's `share` is its cluster's present power in the unit of energy_scale, for
// the energy counters. Every photon counts alike.
PHOTON_KERNEL(photons, (WORLD_ARGUMENTS, __global const DeviceEmitter* emitters,
                        LAYER_FILM_ARGUMENTS(film), __global const float* mean_reflectance, // [cluster][reflector]
                        volatile __global long* energy,                                     // [OUTCOME_COUNT]
                        DeviceCamera camera, DevicePhotonLaunch launch),
                       (WORLD_NAMES, emitters, LAYER_FILM_NAMES(film), mean_reflectance, energy, camera, launch)) {
  const World world = WORLD;
  const LayerFilm film = LAYER_FILM(film, launch.iteration);
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = index * NEPHROID_PHOTONS_PER_ITEM + k;
    if (number >= launch.count) break;
    const uint photon = launch.offset + launch.stride * number;
    const PhotonStart start =
        photon_start(emitters, scene.emitter_count, world.lights, launch.seed, launch.iteration,
                     launch.first_iteration, photon);
    const DeviceEmitter emitter = emitters[start.emitter];
    const Emission emission = emit(&world, emitter.light, start.emission, start.place);
    if (emission.watts == 0.0f) continue;
    const Band band = flat_cluster(&world.tables, emitter.cluster, start.wavelength);
    Path path = {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE,
                 world.lights[emitter.light].inside,    full_throughput(),  emission.behind};
    const PhotonEnd end = trace_way(&world, &band, &path, launch.seed, launch.iteration, photon);
    const float left = flat_part_left(&path.throughput);
    if (end.outcome == OUTCOME_DEPOSITED) {
      const Splat splat = splat_at(&world, &camera, &end.surface, end.triangle, path.direction);
      const int reflector = material_of(&world, end.surface.object).reflector,
                layer = emitter.light * scene.cluster_count + emitter.cluster;
      if (splat.pixel >= 0 &&
          !layer_add(&film, splat.pixel, reflector, layer, emission.watts * left * splat.weight / PI_F,
                     launch.film_scale, FILM_LIMIT, mean_reflectance + emitter.cluster * scene.reflector_count,
                     start.emission.w))
        add_outcome(outcomes, OUTCOME_REFUSED, 1);
    }
    count_photon(outcomes, end.outcome, end.segments,
                 emission.watts / (float)emitter.photon_count * emitter.share * launch.energy_scale, left);
  }
}
