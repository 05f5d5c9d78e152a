// SPDX-License-Identifier: Apache-2.0
// The bands of the paths of a pass in a cluster. Photons and paths from the eye that meet on a surface have to be of
// one wavelength each: where they jitter, a cluster has NEPHROID_PASS_BANDS wavelengths a pass, one from each part of
// it, and what meets is of one part.
#ifndef NEPHROID_PASS_BAND_H
#define NEPHROID_PASS_BAND_H

#include "kernels/tracing/camera.h"
#include "kernels/tracing/world.h"

// More than one where clusters are few: a picture of few wavelengths has a cast.
#ifndef NEPHROID_PASS_BANDS
#define NEPHROID_PASS_BANDS 1
#endif

// The part of a cluster that u in [0, 1) falls into.
static inline int part_of_cluster(float u) {
  const int part = (int)(u * (float)NEPHROID_PASS_BANDS);
  return part < NEPHROID_PASS_BANDS ? part : NEPHROID_PASS_BANDS - 1;
}

// Parts of all clusters by number: what photon maps tell apart.
static inline int band_number(int cluster, int part) { return cluster * NEPHROID_PASS_BANDS + part; }

static inline Band band_of_pass(const World* world, int cluster, int part, uint2 seed, uint pass) {
  const float within = golden_place(seed, pass, 0u, 1u, (uint)band_number(cluster, part), STREAM_PASS_BAND);
  const float u = ((float)part + within) / (float)NEPHROID_PASS_BANDS;
  return choose_band(world, world->scene.light_count, cluster, u < 0x1.fffffep-1f ? u : 0x1.fffffep-1f);
}

#endif
