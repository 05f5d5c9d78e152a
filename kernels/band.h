// SPDX-License-Identifier: Apache-2.0
// Which wavelengths a path stands for: a whole cluster, at the cluster's mean index of refraction (thesis 4.1), or with NEPHROID_JITTER one
// wavelength of it, drawn for each path, that speaks for all. The first is biased, the second is not.
#ifndef NEPHROID_BAND_H
#define NEPHROID_BAND_H

#include "shared_types.h"

#ifndef NEPHROID_JITTER
#define NEPHROID_JITTER 1
#endif

typedef struct {
  int cluster;    // -1: all wavelengths, which go the same way where nothing is bent
  int wavelength; // 0..400; -1: the whole cluster
  float weight;   // of a single wavelength: 1 / its probability in the cluster
} Band;

static inline Band whole_cluster(int cluster)
{
  const Band band = {cluster, -1, 1.0f};
  return band;
}

// The first member of a cluster with cdf > u; cdf: of its members, [count], the last 1; u in [0, 1).
static inline int member_of_cluster(__global const float* cdf, int count, float u)
{
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high) >> 1;
    if (cdf[middle] > u)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// One wavelength of a cluster.
static inline Band wavelength_of_cluster(int cluster, __global const int* wavelengths, __global const float* cdf, int count, float u)
{
  const int member = member_of_cluster(cdf, count, u);
  const float before = member > 0 ? cdf[member - 1] : 0.0f;
  const Band band = {cluster, wavelengths[member], 1.0f / (cdf[member] - before)};
  return band;
}

#endif
