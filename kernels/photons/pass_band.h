// SPDX-License-Identifier: Apache-2.0
// The bands of a pass's paths in a cluster. Photons and paths from the eye that meet on a surface must share one
// wavelength. Where they jitter, a cluster has NEPHROID_PASS_BANDS wavelengths a pass, one from each part of it.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/world.h"

// More than one where clusters are few, for a picture of few wavelengths has a colour cast.
#ifndef NEPHROID_PASS_BANDS
#define NEPHROID_PASS_BANDS 1
#endif

// The part of a cluster that contains u in [0, 1).
static inline int part_of_cluster(float u) {
  const int part = (int)(u * (float)NEPHROID_PASS_BANDS);
  return part < NEPHROID_PASS_BANDS ? part : NEPHROID_PASS_BANDS - 1;
}

// The number of a part among those of all clusters, which photon maps keep apart.
static inline int band_number(int cluster, int part) { return cluster * NEPHROID_PASS_BANDS + part; }

static inline Band band_of_pass(const World* world, int cluster, int part, uint2 seed, uint pass) {
  const float within = golden_place(seed, pass, 0u, 1u, (uint)band_number(cluster, part), STREAM_PASS_BAND);
  const float u = ((float)part + within) / (float)NEPHROID_PASS_BANDS;
  return choose_band(world, world->scene.light_count, cluster, u < 0x1.fffffep-1f ? u : 0x1.fffffep-1f);
}

// Lets another wavelength of its cluster lead a band.
static inline void lead(Band* band, Band leader) {
  band->wavelength = leader.wavelength;
  band->weight = leader.weight;
  band->own.wavelengths.x = leader.own.wavelengths.x;
  band->own.weights.x = leader.own.weights.x;
}
