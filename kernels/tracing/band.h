// SPDX-License-Identifier: Apache-2.0
// The wavelengths of a path: a whole cluster, at the cluster's mean index of refraction (thesis 4.1), which is biased.
// Or with NEPHROID_JITTER one wavelength that stands for its cluster, which is not. It is drawn for each path; with
// photon maps a few are drawn for a pass (pass_band.h).
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/random.h"

#ifndef NEPHROID_JITTER
#define NEPHROID_JITTER 1
#endif

typedef struct {
  int cluster;    // -1: all wavelengths, which go the same way where nothing is bent
  int wavelength; // 0..400; -1: the whole cluster
  float weight;   // for a single wavelength: 1 / its probability in the cluster
} Band;

static inline Band whole_cluster(int cluster) {
  const Band band = {cluster, -1, 1.0f};
  return band;
}

// One wavelength of a cluster, whose members are `wavelengths` and have this cdf; u in [0, 1).
static inline Band wavelength_of_cluster(int cluster, __global const int* wavelengths, __global const float* cdf,
                                         int count, float u) {
  const int member = choose(cdf, count, u);
  const float before = chance_before(cdf, member);
  const Band band = {cluster, wavelengths[member], 1.0f / (cdf[member] - before)};
  return band;
}
