// SPDX-License-Identifier: Apache-2.0
// The band of a pass's paths in a cluster. Photons and paths from the eye that meet on a surface must share one
// wavelength, where they jitter.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/world.h"

static inline Band band_of_pass(const World* world, int cluster, uint2 seed, uint pass) {
  return choose_band(world, world->scene.light_count, cluster,
                     golden_place(seed, pass, 0u, 1u, (uint)cluster, STREAM_PASS_BAND));
}

// Lets another wavelength of its cluster lead a band.
static inline void lead(Band* band, Band leader) {
  band->wavelength = leader.wavelength;
  band->weight = leader.weight;
  band->own.wavelengths.x = leader.own.wavelengths.x;
  band->own.weights.x = leader.own.weights.x;
}
