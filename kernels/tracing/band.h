// SPDX-License-Identifier: Apache-2.0
// The wavelengths of a path. It goes the way of a whole cluster, at the cluster's mean index of refraction (thesis
// 4.1), which is biased. Or with NEPHROID_JITTER it goes the way of one wavelength that stands for its cluster, which
// is not. That is drawn for each path; with photon maps one is drawn for a pass (pass_band.h).
//
// Four wavelengths carry what is left of a path's light (throughput.h), and the first of them leads: the path goes its
// way. These are hero wavelengths (Wilkie et al. 2014, "Hero Wavelength Spectral Sampling").
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/random.h"

#ifndef NEPHROID_JITTER
#define NEPHROID_JITTER 1
#endif

// 0: whatever reflects or refracts a path splits its wavelengths.
#ifndef NEPHROID_UNSPLIT
#define NEPHROID_UNSPLIT 1
#endif

typedef struct {
  int4 wavelengths; // 0..400
  float4 weights;   // 1 / (4 * their probabilities)
  int middle;       // a fifth wavelength, which no random number chooses
} Carriers;

typedef struct {
  int cluster;    // -1: all wavelengths, which go the same way where nothing is bent
  int wavelength; // 0..400, the one that leads; -1: the whole cluster goes the same way
  float weight;   // for a single wavelength: 1 / its probability in the cluster
  Carriers own;   // of the cluster, or of the spectrum's part
  Carriers all;   // of all clusters, until glass splits them; their weights are times `chance`
  float chance;   // of the cluster or part among all that might lead; 0: the path has but those from the start
  // The part of the spectrum that a path from the eye stands for where glass has split it, as places (member_at) from
  // `low` on; size 0: the cluster, or the wavelength.
  float low, size;
  float within; // the leader's place in that part, 0..1
} Band;

static inline Band whole_cluster(int cluster) {
  const Band band = {cluster, -1, 1.0f, {(int4)(0), (float4)(0.25f), 0}};
  return band;
}

static inline Band one_wavelength(int cluster, int wavelength, float weight) {
  const Band band = {cluster, wavelength, weight, {(int4)(wavelength), (float4)(0.25f * weight), wavelength}};
  return band;
}

// A member of a cluster, or of the spectrum.
typedef struct {
  int wavelength;
  float weight; // 1 / its probability
} DrawnWavelength;

// wavelengths: the members, which have this cdf. u: in [0, 1).
static inline DrawnWavelength wavelength_of_cluster(__global const int* wavelengths, __global const float* cdf,
                                                    int count, float u) {
  const int member = choose(cdf, count, u);
  const DrawnWavelength drawn = {wavelengths[member], 1.0f / (cdf[member] - chance_before(cdf, member))};
  return drawn;
}

static inline Carriers carriers_of(DrawnWavelength first, DrawnWavelength second, DrawnWavelength third,
                                   DrawnWavelength fourth, int middle) {
  const Carriers carriers = {
      (int4)(first.wavelength, second.wavelength, third.wavelength, fourth.wavelength),
      0.25f * (float4)(first.weight, second.weight, third.weight, fourth.weight), middle};
  return carriers;
}

// Gives a band of one wavelength the light of all clusters, until the path is split. The others are drawn as the leader
// is. chances: of all four's clusters.
static inline void carry_all(Band* band, DrawnWavelength second, DrawnWavelength third, DrawnWavelength fourth,
                             float4 chances) {
  const DrawnWavelength leader = {band->wavelength, band->weight};
  band->all = carriers_of(leader, second, third, fourth, WAVELENGTH_COUNT / 2);
  band->all.weights *= chances.x / chances;
  band->chance = chances.x;
}

static inline float number_of_four(float4 four, int i) {
  return i == 0 ? four.x : i == 1 ? four.y : i == 2 ? four.z : four.w;
}

static inline int number_of_four_wavelengths(const Carriers* carriers, int i) {
  const int4 four = carriers->wavelengths;
  return i == 0 ? four.x : i == 1 ? four.y : i == 2 ? four.z : four.w;
}

// u in [0, 1), turned by `quarters` quarters.
static inline float quarters_on(float u, int quarters) {
  const float sum = u + 0.25f * (float)quarters;
  return sum < 1.0f ? sum : sum - 1.0f;
}
